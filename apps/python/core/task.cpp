#include "python/core/task.hpp"

#include <chrono>
#include <optional>
#include <thread>

#include "boresight/mechanism/interruption.hpp"

namespace py = pybind11;

namespace boresight::python {
namespace {

thread_local const Task* current = nullptr;

bool go_on(const char*, double) { return current == nullptr || !current->stop(); }

}  // namespace

std::mutex& one_at_a_time() {
  static std::mutex mutex;
  return mutex;
}

void watch_tasks() { watch_work(go_on); }

void Task::tell(double done, double total, const std::string& unit, const std::string& estimate) {
  const std::scoped_lock lock(mutex_);
  told_ = {done, total, unit, estimate};
  news_ = true;
}

void Task::call_progress() {
  Told told;
  {
    const std::scoped_lock lock(mutex_);
    if (!news_ || progress_.is_none()) return;
    news_ = false;
    told = told_;
  }
  progress_(told.done, told.total, told.unit, told.estimate);
}

void Task::run(const std::function<void()>& work) {
  std::exception_ptr fault;
  std::thread thread([&] {
    current = this;
    try {
      work();
    } catch (...) {
      fault = std::current_exception();
    }
    const std::scoped_lock lock(mutex_);
    done_ = true;
    ended_.notify_one();
  });
  std::optional<py::error_already_set> raised;
  for (bool done = false; !done;) {
    {
      const py::gil_scoped_release release;
      std::unique_lock lock(mutex_);
      done = ended_.wait_for(lock, std::chrono::milliseconds(100), [this] { return done_; });
    }
    if (done || stop_) continue;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      call_progress();
    } catch (py::error_already_set& error) {
      raised = error;
      stop_ = true;
    }
  }
  thread.join();
  if (raised) throw py::error_already_set(*raised);
  if (fault) std::rethrow_exception(fault);
}

}  // namespace boresight::python
