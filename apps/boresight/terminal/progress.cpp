#include "terminal/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "terminal/columns.hpp"
#include "terminal/embedding.hpp"
#include "terminal/terminal.hpp"
#include "terminal/work_line.hpp"

namespace boresight::app {
namespace {

using std::chrono::milliseconds;

std::string time_left(double seconds) {
  if (seconds < 90.0) return fmt::format("{:.0f} s left", seconds);
  if (seconds < 5400.0) return fmt::format("{:.0f} min left", seconds / 60.0);
  return fmt::format("{:.1f} h left", seconds / 3600.0);
}

std::size_t terminal_width(std::FILE* stream) {
  winsize size = {};
  if (::ioctl(::fileno(stream), TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return size.ws_col;
}

}  // namespace

std::string progress_line(double done, double total, const std::string& unit, double elapsed_seconds,
                          const std::string& estimate, double before) {
  constexpr int kBar = 20;
  const double share = total > 0.0 ? std::clamp(done / total, 0.0, 1.0) : 0.0;
  const int filled = static_cast<int>(share * kBar);
  const double rate = elapsed_seconds > 0.0 ? (done - before) / elapsed_seconds : 0.0;
  // Before the first of them is done nothing is known of the rate; after the last one something else goes on.
  const bool paced = rate > 0.0 && done < total;
  const std::string time = paced ? time_left((total - done) / rate) : fmt::format("{:.0f} s so far", elapsed_seconds);
  const std::string bar = fmt::format("[{}{}] {:3.0f} %", std::string(filled, '#'), std::string(kBar - filled, '-'),
                                      100.0 * share),
                    more = estimate.empty() ? "" : "; " + estimate;
  if (unit.empty()) return fmt::format("{}  {}{}", bar, time, more);
  // How many there are was an estimate: it is not "27 of 24".
  if (done > total) return fmt::format("{}  {:.3g} {}, {}{}", bar, done, unit, time, more);
  return fmt::format("{}  {:.3g} of {:.3g} {}, {}{}{}", bar, done, total, unit,
                     paced ? fmt::format("{:.3g}/s, ", rate) : "", time, more);
}

Progress::Progress(bool quiet, double total, std::string unit)
    : Progress(quiet                     ? Style::silent
               : ::isatty(STDERR_FILENO) ? Style::terminal
                                         : Style::plain,
               total, std::move(unit), stderr) {}

Progress::Progress(Style style, double total, std::string unit, std::FILE* stream)
    : style_(style), total_(total), unit_(std::move(unit)), stream_(stream) {
  // What is done within a moment needs no progress.
  next_ = start_ + (style_ == Style::terminal ? milliseconds(300) : milliseconds(5000));
}

Progress::~Progress() { clear(); }

void Progress::clear() {
  const std::scoped_lock lock(mutex_);
  if (drawn_ && style_ == Style::terminal) {
    std::fputs("\r\033[K", stream_);
    std::fflush(stream_);
  }
  drawn_ = false;
}

void Progress::update(double done, const std::string& estimate) { update_from(0.0, done, estimate); }

void Progress::update_from(double before, double done, const std::string& estimate) {
  if (const Embedding* host = embedding()) return host->progress(done, total_, unit_, estimate);
  if (style_ == Style::silent) return;
  const std::scoped_lock lock(mutex_);
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  if (style_ == Style::terminal) clear_work_line();
  std::string line = progress_line(done, total_, unit_, elapsed, printable(estimate), before);
  if (style_ == Style::terminal) {
    line = first_columns(line, terminal_width(stream_) - 1);
    fmt::print(stream_, "\r\033[K{}", line);
    next_ = now + milliseconds(100);
  } else {
    fmt::print(stream_, "{}\n", line);
    next_ = now + milliseconds(10000);
  }
  std::fflush(stream_);
  drawn_ = true;
}

}  // namespace boresight::app
