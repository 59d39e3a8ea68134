// Work on several threads at once (oneTBB): the one parallel loop that every analysis uses.
#pragma once

#include <cstddef>
#include <functional>

namespace boresight {

// Calls `work` once on each of `jobs` threads, the caller's among them, and returns when all calls have. Each takes what it
// does from something that they share. The first fault that one throws is thrown on when all have ended; `at_fault` is called
// as it is met, so that the others can be told to end. With one job the caller does it alone.
void on_threads(int jobs, const std::function<void()>& work, const std::function<void()>& at_fault = {});

// work(k) for each k below `count`, in ascending order as threads get free; none is begun after a fault.
void for_each_on_threads(std::size_t count, int jobs, const std::function<void(std::size_t)>& work,
                         const std::function<void()>& at_fault = {});

}  // namespace boresight
