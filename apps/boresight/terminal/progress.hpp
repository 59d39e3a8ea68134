// How far long work has come, on stderr: one line redrawn on a terminal, a plain line now and then elsewhere,
// nothing with --quiet.
//
//   Progress progress(options.quiet);
//   progress.update(0.4, "position error so far 0.21 mm");   // from any thread, as often as one likes
//
// A study shows it by StudyRun::stage (results/verb_study.cpp). `run` and `stability` use it as it is: they are no studies, and
// have no StudyRun.
#pragma once

#include <chrono>
#include <cstdio>
#include <mutex>
#include <string>

namespace boresight::app {

class Progress {
 public:
  enum class Style { silent, plain, terminal };

  // `what` is being counted in `total` units: "s of motion", "points", ...; the rate is given in them. "": a share that
  // counts nothing.
  Progress(bool quiet, double total, std::string unit);
  Progress(Style style, double total, std::string unit, std::FILE* stream);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(double done, const std::string& estimate);
  // The same where `before` of what is done was done in an earlier run: rate and time left are of this one.
  void update_from(double before, double done, const std::string& estimate);
  // Takes the line off the terminal, before something else is printed.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  const Style style_;
  const double total_;
  const std::string unit_;
  std::FILE* const stream_;
  const Clock::time_point start_ = Clock::now();
  std::mutex mutex_;
  Clock::time_point next_;
  bool drawn_ = false;
};

// "[#####-----]  50 %  0.5 of 1 s of motion, 0.32/s, 2 s left; ESTIMATE": what is drawn, without the
// terminal's codes.
std::string progress_line(double done, double total, const std::string& unit, double elapsed_seconds,
                          const std::string& estimate, double before = 0.0);

}  // namespace boresight::app
