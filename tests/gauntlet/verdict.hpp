// What a scene came to: every stage that was tried, what was refused and why, and what is wrong.
#pragma once

#include <string>
#include <vector>

#include "sandbox.hpp"

namespace boresight::gauntlet {

struct Fault {
  std::string kind;   // crash, hang, not finite, disagreement, bound, invariance, momentum, energy, auto, verb
  std::string stage;  // "perturbation rosenbrock"
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
  std::string scene;    // "seed 17", or the file
  std::string family;
  std::vector<Fault> faults;
  std::vector<Refusal> refusals;
  std::vector<Claim> claims;
  int compared = 0;     // stages whose figures were held against the reference
  std::string refused;  // why nothing could be compared; "" if something was
  double cpu_seconds = 0.0;
};

Json to_json(const Verdict& verdict);
Verdict verdict_from(const Json& json);

// A reason without the numbers and names of its scene.
std::string normalised(std::string reason);

}  // namespace boresight::gauntlet
