// How long work hears that it is no longer wanted, wherever it is: following an ideal motion, building a scene, checking poses.
//
//   watch_work([](const char* what, double share) { draw(what, share); return !ctrl_c; });   // once, by the program
//   for (...) { work_reached("following the ideal motion", t / duration); ... }               // in loops, as often as one likes
//
// One watch for the whole process, asked from any thread. Where nobody watches, asking costs one load. Integrations have a progress
// of their own (RunOptions), with which they end early and keep what they reached; work that has nothing to show for itself before
// it is done throws.
#pragma once

#include <atomic>

namespace boresight {

// Not a std::exception: what recovers from failures must not take it for one.
struct Interrupted {};

// what: "following the ideal motion"; share: of it, 0 to 1. Returns false to stop. Must be safe to call from many threads.
using WorkWatch = bool (*)(const char* what, double share);

// Null: nobody watches.
void watch_work(WorkWatch watch);

// While it lives, this thread's work ends once `stop` is set, whatever the watch of the process says: one answer of many that are
// computed side by side. One inside another adds to it.
class StopOfThread {
 public:
  explicit StopOfThread(const std::atomic<bool>& stop);
  ~StopOfThread();
  StopOfThread(const StopOfThread&) = delete;
  StopOfThread& operator=(const StopOfThread&) = delete;

  // Whether any that lives in this thread is set.
  static bool any_set();

 private:
  const std::atomic<bool>& stop_;
  const StopOfThread* outer_;
};

// Throws Interrupted where the watch, or a StopOfThread, wants the work to stop.
void work_reached(const char* what, double share);

}  // namespace boresight
