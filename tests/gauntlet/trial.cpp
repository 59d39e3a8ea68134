#include "trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "conservation.hpp"
#include "measure.hpp"
#include "program_trial.hpp"
#include "variants.hpp"

namespace boresight::gauntlet {
namespace {

class Trial {
 public:
  Trial(Verdict& verdict, const TrialOptions& options) : verdict_(verdict), options_(options) {}

  void run(const std::string& text) {
    try {
      mechanism_ = std::make_shared<const Mechanism>(read_mechanism_text(text, "scene.toml"));
    } catch (const std::exception& e) {
      verdict_.refused = std::string("read: ") + e.what();
      return;
    }
    std::optional<ProgramTrial> program;
    if (!options_.program.empty()) {
      program.emplace(*mechanism_, text, options_, verdict_);
      program->check();
    }
    make_reference();
    compare({.rung = "quasistatic"});
    for (const char* rung : {"perturbation", "multibody"})
      for (const std::string& integrator : integrator_names(rung)) {
        if (integrator == "rk4")
          compare({.rung = rung});  // what runs take where none is asked for
        else if (options_.integrators)
          compare({.rung = rung, .integrator = integrator});
      }
    compare({.rung = "multibody", .formulation = "paper"});
    compare({.rung = "envelope"});
    if (options_.invariances) compare_variants(text);
    check_momentum(mechanism_, options_.limits, verdict_);
    check_energy(mechanism_, options_.limits, verdict_);
    if (program && options_.automatic && !reference_.empty()) {
      const Center truth = center(reference_, 0);
      program->automatic({truth.median, 3.0 * truth.spread + reference_.front().by_steps[0] + floor_of(0)});
    }
    if (program && options_.verbs) program->verbs();
    if (verdict_.compared == 0 && verdict_.refused.empty())
      verdict_.refused = verdict_.refusals.empty() ? "nothing compared" : verdict_.refusals.front().reason;
  }

 private:
  // Runs it in a process of its own; what goes wrong is noted. `quiet`: refusals are not.
  std::optional<Measured> measure_safely(const Asked& asked, bool quiet = false) {
    const Outcome outcome = in_sandbox(
        options_.limits, [&] { return measure(mechanism_, asked, kMostOfLimit * options_.limits.cpu_seconds); });
    verdict_.cpu_seconds += outcome.cpu_seconds;
    switch (outcome.end) {
      case Outcome::End::crashed:
        verdict_.fault("crash", asked.label(), outcome.reason);
        return {};
      case Outcome::End::out_of_time:
        verdict_.fault("hang", asked.label(), outcome.reason);
        return {};
      case Outcome::End::refused:
        if (!quiet) verdict_.refusals.push_back({asked.label(), outcome.reason});
        return {};
      case Outcome::End::answered:
        break;
    }
    Measured m = measured(outcome.answer);
    if (!m.not_finite.empty()) {
      verdict_.fault("not finite", asked.label(), m.not_finite);
      return {};
    }
    return m;
  }

  // Multibody at half its own step and two neighbours of it; more neighbours when a comparison is close.
  void make_reference() {
    const Asked own{.rung = "multibody"};
    const std::optional<Measured> first = measure_safely(own);
    if (!first) {
      if (!verdict_.refusals.empty()) verdict_.refused = "multibody: " + verdict_.refusals.back().reason;
      return;
    }
    base_["multibody"] = *first;
    for (double factor : {1.0, 0.93, 1.06}) add_reference(factor);
  }

  // The same run as one that chose for itself, at other steps or another tolerance.
  static Asked beside(Asked asked, const Measured& chosen, double factor, double finer = 1.0) {
    if (chosen.taken.empty()) {
      asked.step = (finer < 1.0 ? 0.5 : 1.0) * factor * chosen.step;
      return asked;
    }
    asked.integrator = chosen.taken;
    asked.tolerance = finer * factor * (asked.rung == "multibody" ? kMultibodyTolerance : kPerturbationTolerance);
    return asked;
  }
  Asked reference_asked(double factor) { return beside({.rung = "multibody"}, base_["multibody"], factor, 0.1); }

  void add_reference(double factor) {
    const std::optional<Measured> m = measure_safely(reference_asked(factor), true);
    if (m) reference_.push_back(*m);
  }

  struct Center {
    double median = 0.0, spread = 0.0;
  };
  static Center center(const std::vector<Measured>& runs, std::size_t figure) {
    std::vector<double> values;
    for (const Measured& m : runs) values.push_back(m.figure[figure]);
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return {n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]),
            0.5 * (values.back() - values.front())};
  }

  // Differences below this mean nothing: a ten-thousandth of the smallest play.
  double floor_of(std::size_t figure) const {
    const double play = smallest_clearance(mechanism_->parameters());
    const double length = mechanism_->characteristic_length();
    const double smallest = play > 0.0 ? 1e-4 * play : 1e-9 * length;
    if (figure < 2) return smallest;
    const auto& sight = mechanism_->description().line_of_sight;
    return smallest / (figure >= 6 && sight ? std::max(length, (sight->target - sight->from).norm()) : length);
  }

  struct Gap {
    double beyond = 0.0;  // of what was stated and the spread allows; above 0: too far apart
    std::size_t figure = 0;
    double value = 0.0, reference = 0.0, stated = 0.0, spread = 0.0;
  };
  // The figure that is farthest from its reference for what is allowed.
  Gap worst_gap(const std::vector<Measured>& runs) const {
    Gap worst;
    worst.beyond = -1.0;
    for (std::size_t k = 0; k < kFigures.size(); ++k) {
      const Center mine = center(runs, k), theirs = center(reference_, k);
      const double size = std::max(mine.median, theirs.median);
      if (size < floor_of(k)) continue;
      double model = 0.0;
      for (const Measured& m : runs) model = std::max(model, m.model[k]);
      const double stated = model * size + runs.front().by_steps[k];
      const double spread = 2.0 * (theirs.spread + mine.spread);
      const double allowed = stated + reference_.front().by_steps[k] + spread + floor_of(k);
      const double beyond = std::abs(mine.median - theirs.median) / allowed - 1.0;
      if (beyond > worst.beyond) worst = {beyond, k, mine.median, theirs.median, stated, spread};
    }
    return worst;
  }

  void add_references(std::size_t count, double first, double spacing) {
    while (reference_.size() < count) {
      const std::size_t before = reference_.size();
      add_reference(first + spacing * static_cast<double>(before));
      if (reference_.size() == before) return;
    }
  }

  // The same from other steps, or with another tolerance, or from a start beside: what a motion is one of.
  void add_neighbours(std::vector<Measured>& runs, const Asked& asked, const std::vector<double>& factors) {
    if (asked.rung == "quasistatic") return;
    const bool perturbed = asked.rung == "perturbation";
    const bool stepped = asked.integrator.empty() || asked.integrator == "generalized-alpha";
    const Measured chosen = runs.front();
    for (const double factor : factors) {
      Asked neighbour = asked;
      if (perturbed) neighbour.start_offset = (factor - 1.0) * 1e-3 * smallest_clearance(mechanism_->parameters());
      if (stepped)
        neighbour = beside(neighbour, chosen, factor);
      else if (!perturbed)
        neighbour.tolerance = factor * kMultibodyTolerance;
      if (const auto n = measure_safely(neighbour, true)) runs.push_back(*n);
    }
  }

  void compare(const Asked& asked) {
    const bool own = asked.rung == "multibody" && asked.formulation.empty() && asked.integrator.empty();
    const std::optional<Measured> m =
        own && base_.count("multibody") ? std::optional(base_["multibody"]) : measure_safely(asked);
    if (m && asked.formulation.empty() && asked.integrator.empty()) base_[asked.rung] = *m;
    if (!m || reference_.empty()) return;
    ++verdict_.compared;
    std::vector<Measured> runs = {*m};
    if (asked.rung == "envelope") {
      check_bound(*m);
      return;
    }
    Gap gap = worst_gap(runs);
    if (gap.beyond > 0.0) {  // before a word is said: neighbours of both, so that chaos is not taken for error
      add_references(7, 0.8, 0.05);
      add_neighbours(runs, asked, {0.97, 1.02, 0.94, 1.05});
      gap = worst_gap(runs);
      if (gap.beyond > 0.0) {  // then what the program would state of the steps, which takes more runs
        know_steps(runs.front(), asked, mechanism_);
        if (!reference_steps_known_) know_steps(reference_.front(), reference_asked(1.0), mechanism_);
        reference_steps_known_ = true;
        gap = worst_gap(runs);
      }
      // A maximum of a motion that impacts scatter may have two likely values, and a few neighbours meet one of them.
      if (gap.beyond > 0.0 && gap.spread > kScatters * std::abs(gap.value - gap.reference)) {
        add_references(20, 0.7, 0.013);
        add_neighbours(runs, asked,
                       {0.98, 1.01, 0.96, 1.03, 0.95, 1.04, 0.93, 1.06, 0.92, 1.07, 0.91, 1.08, 0.9, 1.09, 0.99});
        gap = worst_gap(runs);
      }
    }
    note_claims(asked, runs);
    if (gap.beyond > 0.0) {
      verdict_.fault(
          "disagreement", asked.label(),
          fmt::format("{}: {:.4g}, reference {:.4g} ({:.2g} % apart, {:.2g} % stated, {:.2g} % spread)",
                      kFigures[gap.figure], gap.value, gap.reference, 100 * std::abs(gap.value / gap.reference - 1),
                      100 * gap.stated / gap.reference, 100 * gap.spread / gap.reference));
      verdict_.faults.back().unclaimed = runs.front().steps_refused;
    }
  }

  void know_steps(Measured& run, const Asked& asked, const std::shared_ptr<const Mechanism>& mechanism) {
    Limits limits = options_.limits;  // it takes several times what the run takes
    limits.cpu_seconds *= kFurtherRuns;
    limits.wall_seconds *= kFurtherRuns;
    const Outcome outcome =
        in_sandbox(limits, [&] { return measure_steps(mechanism, asked, 0.4 * limits.cpu_seconds); });
    verdict_.cpu_seconds += outcome.cpu_seconds;
    run.steps_measured = outcome.end == Outcome::End::answered && outcome.answer.contains("by_steps");
    if (run.steps_measured)
      for (std::size_t k = 0; k < kFigures.size(); ++k)
        run.by_steps[k] = outcome.answer["by_steps"][k].is_number() ? outcome.answer["by_steps"][k].get<double>() : 0.0;
    else if (run.steps_refused = outcome.end == Outcome::End::answered; run.steps_refused)
      verdict_.refusals.push_back({asked.label() + ", steps not measured", outcome.answer["why_not"]});
  }

  // Only of runs whose stated error is whole: that of the steps is measured where a comparison asks for it.
  void note_claims(const Asked& asked, const std::vector<Measured>& runs) {
    if (asked.rung != "quasistatic" && !runs.front().steps_measured) return;
    double worst = -1.0;
    Claim claim{asked.label(), "", 0.0, 0.0};
    for (std::size_t k = 0; k < kFigures.size(); ++k) {
      const Center mine = center(runs, k), theirs = center(reference_, k);
      if (std::max(mine.median, theirs.median) < 10.0 * floor_of(k)) continue;
      const double actual = std::max(0.0, std::abs(mine.median - theirs.median) - mine.spread - theirs.spread) /
                            std::max(mine.median, theirs.median);
      if (actual > worst) {
        worst = actual;
        claim = {asked.label(), kFigures[k], actual,
                 runs.front().model[k] + runs.front().by_steps[k] / std::max(mine.median, theirs.median)};
      }
    }
    if (worst >= 0.0) verdict_.claims.push_back(claim);
  }

  // The envelope is a bound: of the largest errors, but for what impacts press in beyond the rest.
  void check_bound(const Measured& bound) {
    double deepest = 0.0;
    for (const Measured& m : reference_) deepest = std::max(deepest, m.deepest);
    for (std::size_t k : {std::size_t{0}, std::size_t{2}, std::size_t{4}, std::size_t{6}}) {
      const Center truth = center(reference_, k);
      if (truth.median < floor_of(k)) continue;
      double allowed = bound.figure[k] * (1.01 + deepest) + truth.spread + floor_of(k);
      if (truth.median > allowed) {  // then what multibody states of its own steps, as where rungs disagree
        if (!reference_steps_known_) know_steps(reference_.front(), reference_asked(1.0), mechanism_);
        reference_steps_known_ = true;
        allowed += reference_.front().by_steps[k];
      }
      if (truth.median > allowed)
        verdict_.fault("bound", "envelope",
                       fmt::format("{}: bound {:.4g}, multibody {:.4g}", kFigures[k], bound.figure[k], truth.median));
    }
  }

  // The same drawing elsewhere, turned, with other names, backwards, in other units: the same figures, but for what chaos
  // makes of rounding, and perturbation's tables of interpolation. Rungs that answer must answer, and refuse where they refuse.
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
      if (variant(mechanism_->description(), name))
        draw(name, [&] { return *variant(mechanism_->description(), name); });
    draw("in other units", [&] { return read_mechanism_text(in_other_units(text), "scene.toml"); });
    for (const Asked& asked : rungs) {
      const bool known = base_.count(asked.rung) != 0;
      if (known && base_[asked.rung].cpu_seconds > kDearRun) {
        verdict_.refusals.push_back({asked.rung + " in other drawings", "left out: a run takes too long"});
        continue;
      }
      for (const auto& [name, mechanism] : drawn) {
        const auto other = mechanism;
        const Outcome outcome = in_sandbox(
            options_.limits, [&] { return measure(other, asked, kMostOfLimit * options_.limits.cpu_seconds); });
        verdict_.cpu_seconds += outcome.cpu_seconds;
        const std::string stage = asked.rung + " " + name;
        if (outcome.end == Outcome::End::crashed || outcome.end == Outcome::End::out_of_time) {
          verdict_.fault("invariance", stage, outcome.reason);
        } else if (outcome.end == Outcome::End::refused) {
          if (known) verdict_.fault("invariance", stage, "refused: " + outcome.reason);
        } else if (known) {
          Measured found = measured(outcome.answer);
          compare_with_base(asked, stage, base_[asked.rung], found, other);
        }
      }
    }
  }

  // Lists in another order cut the loops elsewhere: other joint coordinates, and in these the same steps leave another error. So do other
  // steps, where rounding decided whether the first choice was found to be too large; and steps that follow an error in coordinates.
  bool within_steps(const Asked& asked, const std::string& stage, std::size_t figure, double apart, Measured& other,
                    const std::shared_ptr<const Mechanism>& mechanism) {
    Measured& base = base_[asked.rung];
    const bool recut = asked.rung == "multibody" && stage.ends_with("reordered"),
               restepped = std::abs(other.step / base.step - 1.0) > 1e-6;
    const bool by_error = !base.taken.empty() || !other.taken.empty();
    if (!(recut || restepped || by_error)) return false;
    if (!base.steps_measured) know_steps(base, asked, mechanism_);
    if (!other.steps_measured) know_steps(other, asked, mechanism);
    return base.steps_measured && other.steps_measured && apart <= base.by_steps[figure] + other.by_steps[figure];
  }

  void compare_with_base(const Asked& asked, const std::string& stage, const Measured& base, Measured& other,
                         const std::shared_ptr<const Mechanism>& mechanism) {
    for (std::size_t k = 0; k < kFigures.size(); ++k) {
      const double size = std::max(base.figure[k], other.figure[k]), apart = std::abs(base.figure[k] - other.figure[k]);
      const double alike = asked.rung == "perturbation" ? kTabled * size : 1e-6 * size;
      if (size < floor_of(k) || apart <= alike) continue;
      if (asked.rung != "quasistatic" && (apart <= alike + 3.0 * neighbours_spread(asked, k, 5) ||
                                          apart <= alike + 3.0 * neighbours_spread(asked, k, 17)))
        continue;
      if (within_steps(asked, stage, k, apart, other, mechanism)) continue;
      if (asked.rung != "quasistatic" && neighbours_spread(asked, k, 17) > kChaotic * apart &&
          apart <= 3.0 * rounded_spread(asked, k))
        continue;
      verdict_.fault(
          "invariance", stage,
          fmt::format("{}: {:.10g}, as drawn {:.10g} ({:.2g} % apart, neighbours scatter by {:.2g} %){}", kFigures[k],
                      other.figure[k], base.figure[k], 100.0 * apart / size,
                      100.0 * (asked.rung == "quasistatic" ? 0.0 : neighbours_spread(asked, k, 17)) / size,
                      (other.start == base.start
                           ? ""
                           : "; starts otherwise: \"" + other.start + "\", as drawn \"" + base.start + "\"") +
                          (std::abs(other.step / base.step - 1.0) < 1e-6
                               ? ""
                               : fmt::format("; steps {:.6g} s, as drawn {:.6g} s", other.step, base.step))));
      return;
    }
  }

  // What rounding may grow to: the figure's range over so many steps that differ by a percent. (Less would round to the same steps.)
  double neighbours_spread(const Asked& asked, std::size_t figure, int count) {
    std::vector<Measured>& runs = neighbours_[asked.rung];
    int& tried = neighbours_tried_[asked.rung];
    if (runs.empty()) runs.push_back(base_[asked.rung]);
    for (; tried + 1 < count; ++tried) {
      Asked neighbour = asked;
      const double by = 0.0025 * (2 + tried / 2);
      neighbour = beside(neighbour, base_[asked.rung], tried % 2 == 0 ? 1.0 - by : 1.0 + by);
      if (const auto m = measure_safely(neighbour, true)) runs.push_back(*m);
    }
    return center(runs, figure).spread;
  }

  // The same over numbers that differ as those of another drawing do. Only where steps scatter much too: where they do not, what follows
  // rounding is a fault.
  double rounded_spread(const Asked& asked, std::size_t figure) {
    std::vector<Measured>& runs = rounded_[asked.rung];
    if (runs.empty()) {
      runs.push_back(base_[asked.rung]);
      for (int k = 1; k <= 12; ++k) {
        Asked neighbour = asked;
        neighbour.rounding = kRounded * k;
        if (const auto m = measure_safely(neighbour, true)) runs.push_back(*m);
      }
    }
    return center(runs, figure).spread;
  }

  static constexpr double kChaotic = 0.2;  // neighbours' spread over what is to be explained by chaos
  static constexpr double kRounded =
      1e-12;  // of a gap, and some times it: what a drawing a few metres away leaves of 0.1 mm
  static constexpr double kTabled = 1e-5;      // what tables of time may do to a motion's figure
  static constexpr double kFurtherRuns = 4.0;  // times the limit, for the runs that measure what steps do
  static constexpr double kScatters =
      0.05;  // neighbours' spread over what is to be explained: below, more of them explain nothing
  static constexpr double kMostOfLimit = 0.8;  // of the CPU limit, after which a run is asked to end
  static constexpr double kDearRun = 1.5;      // [s]: variants of dearer runs are left out

  Verdict& verdict_;
  const TrialOptions& options_;
  std::shared_ptr<const Mechanism> mechanism_;
  std::map<std::string, Measured> base_;  // each rung by its own integrator
  std::map<std::string, std::vector<Measured>> neighbours_, rounded_;
  std::map<std::string, int> neighbours_tried_;
  std::vector<Measured> reference_;
  bool reference_steps_known_ = false;
};

}  // namespace

Verdict try_scene(const std::string& name, const std::string& family, const std::string& text,
                  const TrialOptions& options) {
  Verdict verdict;
  verdict.scene = name;
  verdict.family = family;
  Trial(verdict, options).run(text);
  return verdict;
}

}  // namespace boresight::gauntlet
