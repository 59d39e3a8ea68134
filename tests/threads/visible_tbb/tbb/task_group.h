// The part of oneTBB that the loops use, made of std::thread: the thread sanitiser sees what threads hand each other only in code
// that it was compiled into, and Debian's libtbb is not. Stands before the real headers in the tsan preset and nowhere else.
#pragma once

#include <cstddef>
#include <thread>
#include <utility>
#include <vector>

namespace tbb {

class global_control {
 public:
  enum parameter { max_allowed_parallelism };
  global_control(parameter, std::size_t) {}
};

class task_arena {
 public:
  explicit task_arena(int) {}
  template <typename Work>
  void execute(Work&& work) {
    std::forward<Work>(work)();
  }
};

class task_group {
 public:
  task_group() = default;
  task_group(const task_group&) = delete;
  task_group& operator=(const task_group&) = delete;
  ~task_group() { wait(); }
  template <typename Work>
  void run(Work work) {
    threads_.emplace_back(std::move(work));
  }
  void wait() {
    for (std::thread& one : threads_) one.join();
    threads_.clear();
  }

 private:
  std::vector<std::thread> threads_;
};

}  // namespace tbb
