// A scene through the boresight program as a user calls it: `check`, `run --accuracy` and a small study of every verb, each
// with limits, its outputs searched for numbers that are none.
#pragma once

#include <functional>
#include <string>

#include "boresight/mechanism/mechanism.hpp"
#include "trial.hpp"

namespace boresight::gauntlet {

// What `run` may say of the position error's maximum: the reference and what it may be off by besides the accuracy asked for.
struct AutoReference {
  double value = 0.0, slack = 0.0;
};

class ProgramTrial {
 public:
  ProgramTrial(const Mechanism& mechanism, const std::string& text, const TrialOptions& options, Verdict& verdict);
  ~ProgramTrial();
  ProgramTrial(const ProgramTrial&) = delete;
  ProgramTrial& operator=(const ProgramTrial&) = delete;

  void check();
  void automatic(const AutoReference& reference);
  void verbs();

 private:
  // Its exit status, or -1 where there is none; what is wrong is noted.
  int call(const std::string& stage, const std::vector<std::string>& arguments, const std::string& out);
  void search_outputs(const std::string& stage, const std::string& out);
  Json summary(const std::string& out) const;
  std::string path(const std::string& name) const { return folder_ + "/" + name; }

  const Mechanism& mechanism_;
  const TrialOptions& options_;
  Verdict& verdict_;
  std::string folder_;
};

}  // namespace boresight::gauntlet
