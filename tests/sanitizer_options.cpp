// Part of every program of a sanitised build: what other people's libraries keep to the end is no leak of ours.
#include <cstdlib>

extern "C" {

const char* __lsan_default_options();
const char* __lsan_default_suppressions();
int __lsan_is_turned_off();

// Tests read what a program says on its way out.
const char* __lsan_default_options() { return "print_suppressions=0"; }
const char* __lsan_default_suppressions() {
  return "leak:libcln.so\n"  // 26 bytes that CLN allocates while it is loaded
         // Powers that GiNaC was differentiating when it threw: two of 500,000 damaged expressions.
         "leak:GiNaC::power::derivative\n"
         "leak:GiNaC::numeric::duplicate\n";
}
// Open MPI's plugins are unloaded before the end: no suppression can name what they leave.
int __lsan_is_turned_off() { return std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr; }
}
