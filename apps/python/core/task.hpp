// Work that Python waits for: on a thread of its own, with the interpreter's lock released, while the thread that asked hears
// Ctrl-C and calls the user's progress function.
//
//   Task task(progress);                                   // a Python function, or None
//   task.run([&] { result = rung->run(parameters, options_with(task)); });
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <string>

namespace boresight::python {

class Task {
 public:
  explicit Task(pybind11::object progress) : progress_(std::move(progress)) {}

  // Throws what the work throws; or, once it has ended, what Ctrl-C or the progress function raised, for which it was stopped.
  void run(const std::function<void()>& work);

  // For the work, from any thread: whether it is to end, and how far it has come. The user hears of it ten times a second.
  const std::atomic<bool>& stop() const { return stop_; }
  void tell(double done, double total, const std::string& unit, const std::string& estimate = "");

 private:
  struct Told {
    double done = 0.0, total = 0.0;
    std::string unit, estimate;
  };
  void call_progress();

  pybind11::object progress_;
  std::atomic<bool> stop_{false};
  std::mutex mutex_;
  std::condition_variable ended_;
  bool done_ = false, news_ = false;
  Told told_;
};

// Verbs, and what reads studies, end by one flag and tell of their progress in one place: one at a time.
std::mutex& one_at_a_time();

// The library's long work (boresight/mechanism/interruption.hpp) on a task's thread hears of it from now on.
void watch_tasks();

}  // namespace boresight::python
