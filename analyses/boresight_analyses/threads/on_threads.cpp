#include "boresight_analyses/threads/on_threads.hpp"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>

namespace boresight {

void on_threads(int jobs, const std::function<void()>& work, const std::function<void()>& at_fault) {
  std::exception_ptr fault;
  std::mutex mutex;
  const auto guarded = [&] {
    try {
      work();
    } catch (...) {
      const std::scoped_lock lock(mutex);
      if (!fault) fault = std::current_exception();
      if (at_fault) at_fault();
    }
  };
  if (jobs <= 1) {
    guarded();
  } else {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(jobs));
    tbb::task_arena arena(jobs);
    arena.execute([&] {
      tbb::task_group group;
      for (int j = 1; j < jobs; ++j) group.run(guarded);
      guarded();
      group.wait();
    });
  }
  if (fault) std::rethrow_exception(fault);
}

void for_each_on_threads(std::size_t count, int jobs, const std::function<void(std::size_t)>& work,
                         const std::function<void()>& at_fault) {
  std::atomic<std::size_t> next{0};
  const int most = static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(std::max(1, jobs)), count));
  on_threads(
      most,
      [&] {
        for (std::size_t k = next++; k < count; k = next++) work(k);
      },
      [&] {
        next = count;
        if (at_fault) at_fault();
      });
}

}  // namespace boresight
