#include "boresight/mechanism/interruption.hpp"

#include <atomic>

namespace boresight {
namespace {

std::atomic<WorkWatch> watching{nullptr};

}  // namespace

void watch_work(WorkWatch watch) { watching = watch; }

void work_reached(const char* what, double share) {
  const WorkWatch watch = watching.load(std::memory_order_relaxed);
  if (watch != nullptr && !watch(what, share)) throw Interrupted{};
}

}  // namespace boresight
