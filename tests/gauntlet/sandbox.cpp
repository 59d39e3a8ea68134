#include "sandbox.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <ctime>
#include <optional>
#include <stdexcept>
#include <typeinfo>
#include <vector>

#include "boresight/mechanism/error.hpp"

namespace boresight::gauntlet {
namespace {

using Clock = std::chrono::steady_clock;

// What a program may still use once it is asked to end, to write down what it has [s of CPU].
constexpr double kPatience = 10.0;

// patience: beyond the limit, for a program that is asked to end.
void limit_self(const Limits& limits, double patience = 0.0) {
  const rlim_t cpu = static_cast<rlim_t>(std::ceil(limits.cpu_seconds + patience));
  const rlimit time{cpu, cpu + 1}, none{0, 0};
  setrlimit(RLIMIT_CPU, &time);
  setrlimit(RLIMIT_CORE, &none);
}

void write_all(int file, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = ::write(file, text.data() + done, text.size() - done);
    if (n <= 0) return;
    done += static_cast<std::size_t>(n);
  }
}

struct Ended {
  std::string text;
  int status = 0;
  bool out_of_wall_time = false, asked_to_end = false;
  double cpu_seconds = 0.0;
};

// CPU time of a process that still runs [s].
double cpu_seconds_of(pid_t process) {
  clockid_t clock;
  timespec used{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &used) != 0) return 0.0;
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

// Reads what the child writes until it closes its end or the time is up; then waits for it. `polite`: it is asked to end, as by
// Ctrl-C, when it has used cpu_seconds.
Ended listen(int file, pid_t child, double wall_seconds, std::optional<double> polite = {}) {
  Ended ended;
  const auto deadline = Clock::now() + std::chrono::duration<double>(wall_seconds);
  char buffer[1 << 16];
  while (true) {
    const double left = std::chrono::duration<double>(deadline - Clock::now()).count();
    if (left <= 0.0) {
      ended.out_of_wall_time = true;
      kill(child, SIGKILL);
      break;
    }
    pollfd wait{file, POLLIN, 0};
    const double nap = polite ? std::min(left, 0.2) : left;
    if (polite && !ended.asked_to_end && cpu_seconds_of(child) > *polite) {
      ended.asked_to_end = true;
      kill(child, SIGINT);
    }
    if (poll(&wait, 1, static_cast<int>(1e3 * nap) + 1) <= 0) continue;
    const ssize_t n = ::read(file, buffer, sizeof buffer);
    if (n <= 0) break;
    ended.text.append(buffer, static_cast<std::size_t>(n));
  }
  close(file);
  rusage used{};
  wait4(child, &ended.status, 0, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  ended.cpu_seconds = seconds(used.ru_utime) + seconds(used.ru_stime);
  return ended;
}

// Where the child did not leave by its own exit: true, with the end and its name.
bool cut_short(const Ended& ended, Outcome::End& end, std::string& reason) {
  const bool signalled = WIFSIGNALED(ended.status);
  if (ended.out_of_wall_time || (signalled && WTERMSIG(ended.status) == SIGXCPU)) {
    end = Outcome::End::out_of_time;
    reason = ended.out_of_wall_time ? "wall time limit" : "CPU time limit";
    return true;
  }
  if (!signalled) return false;
  end = Outcome::End::crashed;
  reason = strsignal(WTERMSIG(ended.status));
  return true;
}

}  // namespace

Outcome in_sandbox(const Limits& limits, const std::function<Json()>& work) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) {
    close(ends[0]);
    limit_self(limits);
    Json message;
    try {
      message["answer"] = work();
    } catch (const InputError& e) {
      message["refused"] = e.what();
    } catch (const ComputationError& e) {
      message["refused"] = e.what();
    } catch (const std::invalid_argument& e) {  // options that do not go together: the library's contract
      message["refused"] = e.what();
    } catch (const std::exception& e) {
      message["fault"] = std::string(e.what()) + " (" + typeid(e).name() + ")";
    }
    write_all(ends[1], message.dump());
    _exit(0);
  }
  close(ends[1]);
  const Ended ended = listen(ends[0], child, limits.wall_seconds);
  Outcome outcome;
  outcome.cpu_seconds = ended.cpu_seconds;
  if (cut_short(ended, outcome.end, outcome.reason)) return outcome;
  const Json message = Json::parse(ended.text, nullptr, false);
  if (message.is_discarded()) {
    outcome.end = Outcome::End::crashed;
    outcome.reason = "left without an answer, status " + std::to_string(WEXITSTATUS(ended.status));
  } else if (message.contains("fault")) {
    outcome.end = Outcome::End::crashed;
    outcome.reason = "an exception that is no refusal: " + message["fault"].get<std::string>();
  } else if (message.contains("refused")) {
    outcome.end = Outcome::End::refused;
    outcome.reason = message["refused"];
  } else {
    outcome.answer = message["answer"];
  }
  return outcome;
}

ProgramOutcome run_program(const Limits& limits, const std::string& folder, const std::vector<std::string>& arguments) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) {
    close(ends[0]);
    limit_self(limits, kPatience);
    const int nothing = open("/dev/null", O_RDONLY);
    dup2(nothing, 0);
    dup2(ends[1], 1);
    dup2(ends[1], 2);
    if (chdir(folder.c_str()) != 0) _exit(127);
    std::vector<char*> argv;
    for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
    argv.push_back(nullptr);
    execv(argv[0], argv.data());
    _exit(127);
  }
  close(ends[1]);
  const Ended ended = listen(ends[0], child, limits.wall_seconds + kPatience, limits.cpu_seconds);
  ProgramOutcome outcome;
  outcome.asked_to_end = ended.asked_to_end;
  outcome.cpu_seconds = ended.cpu_seconds;
  outcome.output = ended.text.size() > 2000 ? ended.text.substr(ended.text.size() - 2000) : ended.text;
  if (!cut_short(ended, outcome.end, outcome.reason)) outcome.status = WEXITSTATUS(ended.status);
  return outcome;
}

}  // namespace boresight::gauntlet
