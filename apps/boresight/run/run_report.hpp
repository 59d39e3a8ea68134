// The report of `run`: how far off the mechanism points, when, and what happens in its joints.
#pragma once

#include "boresight/mechanism/mechanism.hpp"
#include "boresight/perturbation/predictability.hpp"
#include "boresight/rungs/run_result.hpp"
#include "boresight/stepping/measured_error.hpp"
#include "boresight_analyses/study/rung_choice.hpp"
#include "command_line/command.hpp"
#include "report/document.hpp"
#include "run/axes_section.hpp"

namespace boresight::app {

// Another rung on the same scene.
struct Compared {
  std::string rung;
  RunResult result;
  std::string refusal;  // why it could not follow the motion; "" if it did
};

// measured: of the steps; steps: what is known of their error, in a sentence.
report::Document run_report(const Command& command, const Mechanism& mechanism, const RungChoice& rung,
                            const std::string& leaves_out, const RunResult& result, const std::vector<Compared>& others,
                            const std::optional<AxesComparison>& axes,
                            const std::optional<Predictability>& predictability, const MeasuredError& measured,
                            const std::string& steps);
// "trajectories are predictable up to ..."
std::string predictability_sentence(const Predictability& found);
nlohmann::ordered_json predictability_json(const Predictability& found);

}  // namespace boresight::app
