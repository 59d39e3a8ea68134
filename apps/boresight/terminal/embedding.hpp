// Verbs called from another program, as the Python package does: it hears what the terminal would show, and ends them in the place of
// Ctrl-C. One verb at a time.
//
//   Embedding embedding{.interrupted = [&] { return stop.load(); }, .progress = show, .failed = keep};
//   const Embedded in(embedding);        // until it goes
//   verb.execute(command);
#pragma once

#include <functional>
#include <string>

namespace boresight::app {

struct Embedding {
  std::function<bool()> interrupted;  // asked often, from any thread
  // done of total, in this unit, and how the answer stands; from any thread.
  std::function<void(double done, double total, const std::string& unit, const std::string& estimate)> progress;
  std::function<void(const std::string& reason)> failed;  // why a verb ends with exit status 3
};

class Embedded {
 public:
  explicit Embedded(const Embedding& embedding);
  ~Embedded();
  Embedded(const Embedded&) = delete;
  Embedded& operator=(const Embedded&) = delete;
};

// Null: the terminal's own program.
const Embedding* embedding();

}  // namespace boresight::app
