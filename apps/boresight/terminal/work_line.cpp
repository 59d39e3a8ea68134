#include "terminal/work_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "boresight/mechanism/interruption.hpp"
#include "terminal/interruption.hpp"

namespace boresight::app {

namespace {

class WorkLine {
 public:
  void draw(const char* what, double share) {
    if (!wanted_ || std::this_thread::get_id() != owner_) return;
    const Clock::time_point now = Clock::now();
    if (what != what_) {
      clear();
      what_ = what;
      next_ = now + std::chrono::milliseconds(700);
    }
    if (now < next_) return;
    next_ = now + std::chrono::milliseconds(200);
    fmt::print(stderr, "\r\033[K{}: {:.0f} %", what, 100.0 * share);
    std::fflush(stderr);
    drawn_ = true;
  }
  void clear() {
    if (!drawn_) return;
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
    drawn_ = false;
  }
  void want(bool wanted) { wanted_ = wanted && ::isatty(STDERR_FILENO); }

 private:
  using Clock = std::chrono::steady_clock;
  const std::thread::id owner_ = std::this_thread::get_id();
  bool wanted_ = false, drawn_ = false;
  const char* what_ = nullptr;
  Clock::time_point next_;
};

WorkLine& work_line() {
  static WorkLine line;
  return line;
}

bool go_on(const char* what, double share) {
  if (interruption_unheard()) return false;
  work_line().draw(what, share);
  return true;
}

}  // namespace

void watch_long_work() {
  work_line();
  watch_work(go_on);
}

void show_work(bool wanted) { work_line().want(wanted); }
void clear_work_line() { work_line().clear(); }

}  // namespace boresight::app
