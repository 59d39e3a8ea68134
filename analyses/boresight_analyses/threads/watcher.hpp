// Sets a flag that all threads look at soon after the caller wants the work to end, however long a sample takes.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

namespace boresight {

class Watcher {
 public:
  // interrupted: asked many times a second from a thread of the watcher's own; may be empty. It must outlive the watcher.
  explicit Watcher(const std::function<bool()>& interrupted)
      : thread_([this, &interrupted](const std::stop_token& end) {
          while (!end.stop_requested() && !stop) {
            if (interrupted && interrupted()) stop = true;
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
          }
        }) {}
  std::atomic<bool> stop{false};

 private:
  std::jthread thread_;
};

}  // namespace boresight
