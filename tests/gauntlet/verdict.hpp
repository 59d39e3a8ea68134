// What a scene came to: every stage that was tried, what was refused and why, and what is wrong.
#pragma once

#include <string>
#include <vector>

#include "sandbox.hpp"

namespace boresight::gauntlet {

struct Fault {
  bool known = false;      // on the list of faults not mended yet
  bool unclaimed = false;  // a figure that is off, and of which the run says that its error was not measured
  std::string kind;        // crash, hang, not finite, disagreement, bound, invariance, momentum, energy, auto, verb
  std::string stage;       // "perturbation rosenbrock"
  std::string text;
};

struct Refusal {
  std::string stage, reason;
};

// Actual error over the stated one, of one rung's worst figure.
struct Claim {
  std::string stage, figure;
  double actual = 0.0, stated = 0.0;
};

struct Verdict {
  std::string scene;  // "seed 17", or the file
  std::string family;
  std::vector<Fault> faults;
  std::vector<Refusal> refusals;
  std::vector<Claim> claims;
  int compared = 0;     // stages whose figures were held against the reference
  std::string refused;  // why nothing could be compared; "" if something was
  double cpu_seconds = 0.0;

  void fault(std::string kind, std::string stage, std::string text) {
    faults.push_back({.kind = std::move(kind), .stage = std::move(stage), .text = std::move(text)});
  }
};

Json to_json(const Verdict& verdict);
Verdict verdict_from(const Json& json);

bool has_new_fault(const Verdict& verdict);

// Faults that are known and not mended yet, one a line: "scene | kind | stage | why"; # begins a comment. A scene that is a
// file goes by its name without folder and ending.
class KnownFaults {
 public:
  KnownFaults() = default;
  explicit KnownFaults(const std::string& file);
  void mark(Verdict& verdict);
  // Of the scenes marked: what is listed and did not happen.
  const std::vector<std::string>& gone() const { return gone_; }

 private:
  struct Entry {
    std::string scene, kind, stage;
  };
  std::vector<Entry> entries_;
  std::vector<std::string> gone_;
};

// A reason without the numbers and names of its scene.
std::string normalised(std::string reason);

}  // namespace boresight::gauntlet
