#include "boresight/mechanism/interruption.hpp"

namespace boresight {
namespace {

std::atomic<WorkWatch> watching{nullptr};
thread_local const StopOfThread* innermost = nullptr;

}  // namespace

void watch_work(WorkWatch watch) { watching = watch; }

StopOfThread::StopOfThread(const std::atomic<bool>& stop) : stop_(stop), outer_(innermost) { innermost = this; }

StopOfThread::~StopOfThread() { innermost = outer_; }

bool StopOfThread::any_set() {
  for (const StopOfThread* one = innermost; one != nullptr; one = one->outer_)
    if (one->stop_.load(std::memory_order_relaxed)) return true;
  return false;
}

void work_reached(const char* what, double share) {
  if (StopOfThread::any_set()) throw Interrupted{};
  const WorkWatch watch = watching.load(std::memory_order_relaxed);
  if (watch != nullptr && !watch(what, share)) throw Interrupted{};
}

}  // namespace boresight
