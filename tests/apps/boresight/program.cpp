#include "program.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace boresight::app {

namespace fs = std::filesystem;

void Program::SetUp() {
  std::string name = testing::TempDir() + "boresight-program-XXXXXX";
  ASSERT_NE(::mkdtemp(name.data()), nullptr);
  folder_ = name;
}

void Program::TearDown() { fs::remove_all(folder_); }

pid_t Program::start(const std::vector<std::string>& arguments, std::size_t limit, const PlayedDisk& disk) const {
  std::vector<std::string> words = {BORESIGHT_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const std::string out = folder_ / "stdout", err = folder_ / "stderr";
  const pid_t child = ::fork();
  if (child != 0) return child;
  const int out_file = ::open(out.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
  const int err_file = ::open(err.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
  ::dup2(out_file, STDOUT_FILENO);
  ::dup2(err_file, STDERR_FILENO);
  if (::chdir(folder_.c_str()) != 0) ::_exit(99);
  if (limit > 0) {
    const rlimit most = {limit, limit};
    ::setrlimit(RLIMIT_FSIZE, &most);
  }
  if (!disk.folder.empty()) {
    ::setenv("BORESIGHT_DISK", (fs::canonical(folder_) / disk.folder).c_str(), 1);
    if (disk.room) ::setenv("BORESIGHT_DISK_ROOM", std::to_string(*disk.room).c_str(), 1);
    if (disk.read_only) ::setenv("BORESIGHT_DISK_READ_ONLY", "1", 1);
    ::setenv("LD_PRELOAD", BORESIGHT_PLAYED_DISK, 1);
    const char* given = std::getenv("ASAN_OPTIONS");  // the address sanitiser wants to be first of all libraries
    ::setenv("ASAN_OPTIONS", (std::string(given != nullptr ? given : "") + ":verify_asan_link_order=0").c_str(), 1);
  }
  ::execv(argv[0], argv.data());
  ::_exit(98);
}

Ended Program::wait_for(pid_t child) const {
  int status = 0;
  ::waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), text("stdout"), text("stderr")};
}

void Program::write(const std::string& name, const std::string& content) const {
  std::ofstream(folder_ / name) << content;
}

std::string Program::text(const std::string& name) const {
  std::ifstream in(folder_ / name);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

nlohmann::json Program::json(const std::string& name) const { return nlohmann::json::parse(text(name)); }

std::vector<std::string> Program::files(const std::string& folder) const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder_ / folder)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

bool is_one_line(const std::string& text) { return !text.empty() && text.find('\n') == text.size() - 1; }

}  // namespace boresight::app
