// Entry for libFuzzer (preset fuzz): a mechanism file.
//   build/fuzz/bin/mechanism_fuzzer CORPUS examples/3-rrcpr
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"
#include "valid_description.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const std::string fault =
        boresight::fault_of(boresight::read_mechanism_text({reinterpret_cast<const char*>(data), size}, "fuzz.toml"));
    if (!fault.empty()) {
      std::fprintf(stderr, "let through: %s\n", fault.c_str());
      std::abort();
    }
  } catch (const boresight::InputError&) {
  }
  return 0;
}
