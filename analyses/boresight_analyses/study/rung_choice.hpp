// Which rung of the ladder a question is put to, and why: the sentence goes into every summary.
#pragma once

#include <optional>
#include <string>

#include "boresight/rungs/rung.hpp"
#include "boresight_analyses/study/pilot.hpp"

namespace boresight {

struct RungChoice {
  std::string name;
  std::string why;
  double step = 0.0;                      // that the pilot found [s]; 0: the rung's own, or the user's
  std::string integrator = {};            // that the pilot found; "": the rung's own, or the user's
  double tolerance = 0.0;                 // of it, or without an integrator of lanes; 0: none
  std::optional<PilotResult> pilot = {};  // where one was flown
};

struct RungQuestion {
  std::string asked = "auto";           // a rung's name, or "auto"
  std::optional<double> accuracy = {};  // what is wanted of the index, relative, if anything is
  bool wants_multibody = false;         // an option was given that only multibody has
  IndexChoice index = {};
  double step = 0.0;            // given by the user [s]; 0: none
  std::string integrator = {};  // given by the user; "": none
  double tolerance = 0.0;       // of it
  bool integrators = false;     // the pilot may choose one with error control; hand it on with apply()
  bool lanes = false;           // it may choose lanes; hand their tolerance on with apply()
  std::optional<ScatterStatistic> statistic =
      {};                    // what is asked of the samples' scatter; nothing: they are motions each
  bool scene_varies = true;  // over the scatter: more than contacts do
  std::uint64_t runs = 0;    // that are to be made on the rung; 0: not known
  int jobs = 1;
  std::function<bool(int)> progress = {};  // of the pilot
};

// Of what pilots chose for several designs the one that leaves out least, with the smallest step or tolerance: it serves them all.
RungChoice most_demanding(const std::vector<RungChoice>& choices);

// Puts what the pilot found into the options of the runs to come.
void apply(const RungChoice& choice, RunOptions& options);

// The rung that leaves out less than this one, to confirm on; the same where there is none.
std::string next_rung_up(const std::string& rung, const Mechanism& mechanism);
// The run's options on this rung, with one step for all motions where it takes fixed steps and none was given. An integrator
// that the rung does not have is left out: the question was put to another rung. Throws OptionRefused, ComputationError.
RunOptions options_on(const std::string& rung, const std::shared_ptr<const Mechanism>& mechanism,
                      const std::vector<Parameters>& motions, RunOptions run);

// Throws InputError (key = --rung) for a name that no rung has.
void check_rung_name(const std::string& asked);
// With "auto" and an accuracy a pilot is flown: over the samples' scatter, or over each of them where `statistic` is
// nothing. Without an accuracy the rung that leaves out least is taken.
RungChoice choose_rung(const RungQuestion& question, std::shared_ptr<const Mechanism> mechanism,
                       const std::vector<Parameters>& samples);

}  // namespace boresight
