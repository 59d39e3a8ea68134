#include "terminal/interruption.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>

#include "terminal/embedding.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/work_line.hpp"

namespace boresight::app {
namespace {

volatile std::sig_atomic_t arrived = 0;
std::atomic<bool> heard{false};

void note(int) {
  if (arrived) ::_exit(kInterrupted);
  arrived = 1;
}

}  // namespace

void catch_interruptions() {
  struct sigaction action = {};
  action.sa_handler = note;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  // A reader that went away and a file grown beyond its limit are write errors, not silent deaths in the
  // middle of a file.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool interrupted() {
  if (const Embedding* host = embedding()) return host->interrupted();
  if (arrived) heard = true;
  return arrived != 0;
}

bool interruption_unheard() { return arrived != 0 && !heard; }

}  // namespace boresight::app
