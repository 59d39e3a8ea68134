#include "boresight_analyses/threads/on_threads.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace boresight {
namespace on_threads_test {

TEST(OnThreads, EveryNumberIsDoneOnceWhateverTheThreads) {
  for (const int jobs : {0, 1, 2, 4, 16}) {
    std::vector<std::atomic<int>> done(1000);
    for_each_on_threads(done.size(), jobs, [&](std::size_t k) { ++done[k]; });
    for (const std::atomic<int>& times : done) EXPECT_EQ(times, 1) << jobs;
  }
  for_each_on_threads(0, 4, [](std::size_t) { ADD_FAILURE() << "nothing to do"; });
}

TEST(OnThreads, WorkIsOnAsManyThreadsAsAskedForAtOnce) {
  // Each call waits until all are there.
  std::atomic<int> there{0};
  std::mutex mutex;
  std::set<std::thread::id> threads;
  on_threads(3, [&] {
    ++there;
    while (there < 3) std::this_thread::yield();
    const std::scoped_lock lock(mutex);
    threads.insert(std::this_thread::get_id());
  });
  EXPECT_EQ(threads.size(), 3u);
  EXPECT_TRUE(threads.contains(std::this_thread::get_id())) << "the caller works too";
}

TEST(OnThreads, TheFirstFaultEndsTheWorkAndIsThrownOn) {
  for (const int jobs : {1, 4}) {
    std::atomic<int> begun{0}, told{0};
    const auto work = [&](std::size_t k) {
      ++begun;
      if (k == 5) throw std::runtime_error("five");
    };
    try {
      for_each_on_threads(1'000'000, jobs, work, [&] { ++told; });
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& e) {
      EXPECT_STREQ(e.what(), "five");
    }
    EXPECT_LT(begun, 1'000'000);
    EXPECT_EQ(told, 1);
  }
}

TEST(OnThreads, WorkMayItselfGoOnThreads) {
  std::atomic<int> sum{0};
  for_each_on_threads(4, 2, [&](std::size_t) { for_each_on_threads(8, 2, [&](std::size_t) { ++sum; }); });
  EXPECT_EQ(sum, 32);
}

}  // namespace on_threads_test
}  // namespace boresight
