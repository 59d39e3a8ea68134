#include "invariance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "boresight/io/mechanism_file.hpp"
#include "variants.hpp"

namespace boresight::gauntlet {
namespace {

constexpr double kChaotic = 0.2;  // neighbours' spread over what is to be explained by chaos
constexpr double kTabled = 1e-5;  // what tables of time may do to a motion's figure
constexpr double kDearRun = 1.5;  // [s]: variants of dearer runs are left out

class Invariance {
 public:
  Invariance(SceneRuns& runs, Verdict& verdict, const TrialOptions& options)
      : runs_(runs), verdict_(verdict), options_(options) {}

  void compare_variants(const std::string& text) {
    const std::vector<Asked> rungs = {{.rung = "quasistatic"}, {.rung = "perturbation"}, {.rung = "multibody"}};
    std::map<std::string, std::shared_ptr<const Mechanism>> drawn;
    const auto draw = [&](const std::string& name, const std::function<MechanismDescription()>& make) {
      try {
        drawn[name] = std::make_shared<const Mechanism>(make());
      } catch (const std::exception& e) {
        verdict_.fault("invariance", name, std::string("not even read: ") + e.what());
      }
    };
    for (const std::string& name : variant_names())
      if (variant(runs_.mechanism()->description(), name))
        draw(name, [&] { return *variant(runs_.mechanism()->description(), name); });
    draw("in other units", [&] { return read_mechanism_text(in_other_units(text), "scene.toml"); });
    for (const Asked& asked : rungs) {
      const bool known = runs_.has_base(asked.rung);
      if (known && runs_.base(asked.rung).cpu_seconds > kDearRun) {
        verdict_.refusals.push_back({asked.rung + " in other drawings", "left out: a run takes too long"});
        continue;
      }
      for (const auto& [name, mechanism] : drawn) {
        const auto other = mechanism;
        const Outcome outcome = in_sandbox(options_.limits, [&] {
          return measure(other, asked, SceneRuns::kMostOfLimit * options_.limits.cpu_seconds);
        });
        verdict_.cpu_seconds += outcome.cpu_seconds;
        const std::string stage = asked.rung + " " + name;
        if (outcome.end == Outcome::End::crashed || outcome.end == Outcome::End::out_of_time) {
          verdict_.fault("invariance", stage, outcome.reason);
        } else if (outcome.end == Outcome::End::refused) {
          if (known) verdict_.fault("invariance", stage, "refused: " + outcome.reason);
        } else if (known) {
          Measured found = measured(outcome.answer);
          compare_with_base(asked, stage, runs_.base(asked.rung), found, other);
        }
      }
    }
  }

 private:
  // Lists in another order cut the loops elsewhere: other joint coordinates, and in these the same steps leave another error. So do other
  // steps, where rounding decided whether the first choice was found to be too large; and steps that follow an error in coordinates.
  bool within_steps(const Asked& asked, const std::string& stage, std::size_t figure, double apart, Measured& other,
                    const std::shared_ptr<const Mechanism>& mechanism) {
    Measured& base = runs_.base(asked.rung);
    const bool recut = asked.rung == "multibody" && stage.ends_with("reordered"),
               restepped = std::abs(other.step / base.step - 1.0) > 1e-6;
    const bool by_error = !base.taken.empty() || !other.taken.empty();
    if (!(recut || restepped || by_error)) return false;
    if (!base.steps_measured) runs_.know_steps(base, asked, runs_.mechanism());
    if (!other.steps_measured) runs_.know_steps(other, asked, mechanism);
    return base.steps_measured && other.steps_measured && apart <= base.by_steps[figure] + other.by_steps[figure];
  }

  void compare_with_base(const Asked& asked, const std::string& stage, const Measured& base, Measured& other,
                         const std::shared_ptr<const Mechanism>& mechanism) {
    for (std::size_t k = 0; k < kFigures.size(); ++k) {
      const double size = std::max(base.figure[k], other.figure[k]), apart = std::abs(base.figure[k] - other.figure[k]);
      const double alike = asked.rung == "perturbation" ? kTabled * size : 1e-6 * size;
      if (size < runs_.floor_of(k) || apart <= alike) continue;
      if (asked.rung != "quasistatic" && (apart <= alike + 3.0 * runs_.neighbours_spread(asked, k, 5) ||
                                          apart <= alike + 3.0 * runs_.neighbours_spread(asked, k, 17)))
        continue;
      if (within_steps(asked, stage, k, apart, other, mechanism)) continue;
      if (asked.rung != "quasistatic" && runs_.neighbours_spread(asked, k, 17) > kChaotic * apart &&
          apart <= 3.0 * runs_.rounded_spread(asked, k))
        continue;
      verdict_.fault(
          "invariance", stage,
          fmt::format("{}: {:.10g}, as drawn {:.10g} ({:.2g} % apart, neighbours scatter by {:.2g} %){}", kFigures[k],
                      other.figure[k], base.figure[k], 100.0 * apart / size,
                      100.0 * (asked.rung == "quasistatic" ? 0.0 : runs_.neighbours_spread(asked, k, 17)) / size,
                      (other.start == base.start
                           ? ""
                           : "; starts otherwise: \"" + other.start + "\", as drawn \"" + base.start + "\"") +
                          (std::abs(other.step / base.step - 1.0) < 1e-6
                               ? ""
                               : fmt::format("; steps {:.6g} s, as drawn {:.6g} s", other.step, base.step))));
      return;
    }
  }

  SceneRuns& runs_;
  Verdict& verdict_;
  const TrialOptions& options_;
};

}  // namespace

void compare_variants(SceneRuns& runs, const std::string& text, Verdict& verdict, const TrialOptions& options) {
  Invariance(runs, verdict, options).compare_variants(text);
}

}  // namespace boresight::gauntlet
