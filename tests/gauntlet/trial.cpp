#include "trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "conservation.hpp"
#include "invariance.hpp"
#include "program_trial.hpp"
#include "scene_runs.hpp"

namespace boresight::gauntlet {
namespace {

class Trial {
 public:
  Trial(Verdict& verdict, const TrialOptions& options) : verdict_(verdict), options_(options) {}

  void run(const std::string& text) {
    try {
      runs_.emplace(std::make_shared<const Mechanism>(read_mechanism_text(text, "scene.toml")), verdict_, options_);
    } catch (const std::exception& e) {
      verdict_.refused = std::string("read: ") + e.what();
      return;
    }
    std::optional<ProgramTrial> program;
    if (!options_.program.empty()) {
      program.emplace(*runs_->mechanism(), text, options_, verdict_);
      program->check();
    }
    runs_->make_reference();
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
    if (options_.invariances) compare_variants(*runs_, text, verdict_, options_);
    check_momentum(runs_->mechanism(), options_.limits, verdict_);
    check_energy(runs_->mechanism(), options_.limits, verdict_);
    if (program && options_.automatic && !runs_->reference().empty()) {
      const Center truth = center(runs_->reference(), 0);
      program->automatic(
          {truth.median, 3.0 * truth.spread + runs_->reference().front().by_steps[0] + runs_->floor_of(0)});
    }
    if (program && options_.verbs) program->verbs();
    if (verdict_.compared == 0 && verdict_.refused.empty())
      verdict_.refused = verdict_.refusals.empty() ? "nothing compared" : verdict_.refusals.front().reason;
  }

 private:
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
      const Center mine = center(runs, k), theirs = center(runs_->reference(), k);
      const double size = std::max(mine.median, theirs.median);
      if (size < runs_->floor_of(k)) continue;
      double model = 0.0;
      for (const Measured& m : runs) model = std::max(model, m.model[k]);
      const double stated = model * size + runs.front().by_steps[k];
      const double spread = 2.0 * (theirs.spread + mine.spread);
      const double allowed = stated + runs_->reference().front().by_steps[k] + spread + runs_->floor_of(k);
      const double beyond = std::abs(mine.median - theirs.median) / allowed - 1.0;
      if (beyond > worst.beyond) worst = {beyond, k, mine.median, theirs.median, stated, spread};
    }
    return worst;
  }

  void compare(const Asked& asked) {
    const bool own = asked.rung == "multibody" && asked.formulation.empty() && asked.integrator.empty();
    const std::optional<Measured> m =
        own && runs_->has_base("multibody") ? std::optional(runs_->base("multibody")) : runs_->measure_safely(asked);
    if (m && asked.formulation.empty() && asked.integrator.empty()) runs_->base(asked.rung) = *m;
    if (!m || runs_->reference().empty()) return;
    ++verdict_.compared;
    std::vector<Measured> runs = {*m};
    if (asked.rung == "envelope") {
      check_bound(*m);
      return;
    }
    Gap gap = worst_gap(runs);
    if (gap.beyond > 0.0) {  // before a word is said: neighbours of both, so that chaos is not taken for error
      runs_->add_references(7, 0.8, 0.05);
      runs_->add_neighbours(runs, asked, {0.97, 1.02, 0.94, 1.05});
      gap = worst_gap(runs);
      if (gap.beyond > 0.0) {  // then what the program would state of the steps, which takes more runs
        runs_->know_steps(runs.front(), asked, runs_->mechanism());
        runs_->know_steps_of_reference();
        gap = worst_gap(runs);
      }
      // A maximum of a motion that impacts scatter may have two likely values, and a few neighbours meet one of them.
      if (gap.beyond > 0.0 && gap.spread > kScatters * std::abs(gap.value - gap.reference)) {
        runs_->add_references(20, 0.7, 0.013);
        runs_->add_neighbours(
            runs, asked, {0.98, 1.01, 0.96, 1.03, 0.95, 1.04, 0.93, 1.06, 0.92, 1.07, 0.91, 1.08, 0.9, 1.09, 0.99});
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

  // Only of runs whose stated error is whole: that of the steps is measured where a comparison asks for it.
  void note_claims(const Asked& asked, const std::vector<Measured>& runs) {
    if (asked.rung != "quasistatic" && !runs.front().steps_measured) return;
    double worst = -1.0;
    Claim claim{asked.label(), "", 0.0, 0.0};
    for (std::size_t k = 0; k < kFigures.size(); ++k) {
      const Center mine = center(runs, k), theirs = center(runs_->reference(), k);
      if (std::max(mine.median, theirs.median) < 10.0 * runs_->floor_of(k)) continue;
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
    for (const Measured& m : runs_->reference()) deepest = std::max(deepest, m.deepest);
    for (std::size_t k : {std::size_t{0}, std::size_t{2}, std::size_t{4}, std::size_t{6}}) {
      const Center truth = center(runs_->reference(), k);
      if (truth.median < runs_->floor_of(k)) continue;
      double allowed = bound.figure[k] * (1.01 + deepest) + truth.spread + runs_->floor_of(k);
      if (truth.median > allowed) {  // then what multibody states of its own steps, as where rungs disagree
        runs_->know_steps_of_reference();
        allowed += runs_->reference().front().by_steps[k];
      }
      if (truth.median > allowed)
        verdict_.fault("bound", "envelope",
                       fmt::format("{}: bound {:.4g}, multibody {:.4g}", kFigures[k], bound.figure[k], truth.median));
    }
  }

  // Neighbours' spread over what is to be explained: below, more of them explain nothing.
  static constexpr double kScatters = 0.05;

  Verdict& verdict_;
  const TrialOptions& options_;
  std::optional<SceneRuns> runs_;
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
