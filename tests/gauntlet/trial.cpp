#include "trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "measure.hpp"

namespace boresight::gauntlet {
namespace {

class Trial {
 public:
  Trial(Verdict& verdict, const TrialOptions& options) : verdict_(verdict), options_(options) {}

  void run(const std::string& text) {
    std::shared_ptr<const Mechanism> mechanism;
    try {
      mechanism_ = std::make_shared<const Mechanism>(read_mechanism_text(text, "scene.toml"));
    } catch (const std::exception& e) {
      verdict_.refused = std::string("read: ") + e.what();
      return;
    }
    make_reference();
    for (const char* rung : {"envelope", "quasistatic"}) compare({.rung = rung});
    for (const char* rung : {"perturbation", "multibody"})
      for (const std::string& integrator : integrator_names(rung)) {
        if (integrator != "rk4" && !options_.integrators) continue;
        compare({.rung = rung, .integrator = integrator});
      }
    compare({.rung = "multibody", .integrator = "rk4", .formulation = "paper"});
    if (verdict_.compared == 0 && verdict_.refused.empty())
      verdict_.refused = verdict_.refusals.empty() ? "nothing compared" : verdict_.refusals.front().reason;
  }

 private:
  // Runs it in a process of its own; what goes wrong is noted. `quiet`: refusals are not.
  std::optional<Measured> measure_safely(const Asked& asked, bool quiet = false) {
    const Outcome outcome = in_sandbox(options_.limits, [&] { return measure(mechanism_, asked); });
    verdict_.cpu_seconds += outcome.cpu_seconds;
    switch (outcome.end) {
      case Outcome::End::crashed: verdict_.faults.push_back({"crash", asked.label(), outcome.reason}); return {};
      case Outcome::End::out_of_time: verdict_.faults.push_back({"hang", asked.label(), outcome.reason}); return {};
      case Outcome::End::refused:
        if (!quiet) verdict_.refusals.push_back({asked.label(), outcome.reason});
        return {};
      case Outcome::End::answered: break;
    }
    Measured m = measured(outcome.answer);
    if (!m.not_finite.empty()) {
      verdict_.faults.push_back({"not finite", asked.label(), m.not_finite});
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
    done_["multibody"] = *first;
    step_ = 0.5 * first->step;
    for (double factor : {1.0, 0.93, 1.06}) add_reference(factor);
  }

  void add_reference(double factor) {
    const std::optional<Measured> m = measure_safely({.rung = "multibody", .step = step_ * factor}, true);
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
    return {n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]), 0.5 * (values.back() - values.front())};
  }

  // Differences below this mean nothing: a ten-thousandth of the smallest play.
  double floor_of(std::size_t figure) const {
    const double play = smallest_clearance(mechanism_->parameters());
    const double length = mechanism_->characteristic_length();
    const double smallest = play > 0.0 ? 1e-4 * play : 1e-9 * length;
    return figure < 2 ? smallest : smallest / length;
  }

  struct Gap {
    double beyond = 0.0;  // of what was stated and the spread allows; above 0: too far apart
    std::size_t figure = 0;
    double value = 0.0, reference = 0.0, allowed = 0.0, spread = 0.0;
  };
  // The figure that is farthest from its reference for what is allowed.
  Gap worst_gap(const std::vector<Measured>& runs) const {
    Gap worst;
    worst.beyond = -1.0;
    for (std::size_t k = 0; k < kFigures.size(); ++k) {
      const Center mine = center(runs, k), theirs = center(reference_, k);
      const double size = std::max(mine.median, theirs.median);
      if (size < floor_of(k)) continue;
      double stated = 0.0;
      for (const Measured& m : runs) stated = std::max(stated, m.stated());
      const double spread = 2.0 * (theirs.spread + mine.spread);
      const double allowed = stated * size + reference_.front().discretisation * theirs.median + spread + floor_of(k);
      const double beyond = std::abs(mine.median - theirs.median) / allowed - 1.0;
      if (beyond > worst.beyond) worst = {beyond, k, mine.median, theirs.median, allowed, spread};
    }
    return worst;
  }

  void compare(const Asked& asked) {
    const bool own = asked.rung == "multibody" && asked.formulation.empty() && asked.integrator == "rk4";
    const std::optional<Measured> m = own && done_.count("multibody") ? std::optional(done_["multibody"]) : measure_safely(asked);
    if (!m || reference_.empty()) return;
    ++verdict_.compared;
    std::vector<Measured> runs = {*m};
    if (asked.rung == "envelope") {
      check_bound(*m);
      return;
    }
    Gap gap = worst_gap(runs);
    if (gap.beyond > 0.0) {  // before a word is said: neighbours of both, so that chaos is not taken for error
      while (reference_.size() < 7) {
        const std::size_t before = reference_.size();
        add_reference(0.8 + 0.05 * static_cast<double>(before));
        if (reference_.size() == before) break;
      }
      const bool stepped = asked.integrator == "rk4" || asked.integrator == "generalized-alpha";
      for (double factor : {0.97, 1.02, 0.94, 1.05}) {
        if (asked.rung == "quasistatic") break;
        Asked neighbour = asked;
        if (asked.rung == "perturbation")
          neighbour.start_offset = (factor - 1.0) * 1e-3 * smallest_clearance(mechanism_->parameters());
        if (stepped) neighbour.step = m->step * factor;
        if (!stepped && asked.rung == "multibody") break;
        if (const auto n = measure_safely(neighbour, true)) runs.push_back(*n);
      }
      gap = worst_gap(runs);
    }
    note_claims(asked, runs);
    if (gap.beyond > 0.0)
      verdict_.faults.push_back({"disagreement", asked.label(),
                                 fmt::format("{}: {:.4g}, reference {:.4g} ({:.2g} % apart, {:.2g} % stated, {:.2g} % spread)", kFigures[gap.figure], gap.value,
                                             gap.reference, 100 * std::abs(gap.value / gap.reference - 1), 100 * m->stated(), 100 * gap.spread / gap.reference)});
  }

  void note_claims(const Asked& asked, const std::vector<Measured>& runs) {
    double worst = -1.0;
    Claim claim{asked.label(), "", 0.0, 0.0};
    for (std::size_t k = 0; k < kFigures.size(); ++k) {
      const Center mine = center(runs, k), theirs = center(reference_, k);
      if (std::max(mine.median, theirs.median) < 10.0 * floor_of(k)) continue;
      const double actual = std::max(0.0, std::abs(mine.median - theirs.median) - mine.spread - theirs.spread) / std::max(mine.median, theirs.median);
      if (actual > worst) {
        worst = actual;
        claim = {asked.label(), kFigures[k], actual, runs.front().stated()};
      }
    }
    if (worst >= 0.0) verdict_.claims.push_back(claim);
  }

  // The envelope is a bound: of the largest errors, but for what impacts press in beyond the rest.
  void check_bound(const Measured& bound) {
    double deepest = 0.0;
    for (const Measured& m : reference_) deepest = std::max(deepest, m.deepest);
    for (std::size_t k : {std::size_t{0}, std::size_t{2}, std::size_t{4}}) {
      const Center truth = center(reference_, k);
      if (truth.median < floor_of(k)) continue;
      const double allowed = bound.figure[k] * (1.01 + deepest) + truth.spread + floor_of(k);
      if (truth.median > allowed)
        verdict_.faults.push_back({"bound", "envelope", fmt::format("{}: bound {:.4g}, multibody {:.4g}", kFigures[k], bound.figure[k], truth.median)});
    }
  }

  Verdict& verdict_;
  const TrialOptions& options_;
  std::shared_ptr<const Mechanism> mechanism_;
  std::map<std::string, Measured> done_;
  std::vector<Measured> reference_;
  double step_ = 0.0;
};

}  // namespace

Verdict try_scene(const std::string& name, const std::string& family, const std::string& text, const TrialOptions& options) {
  Verdict verdict;
  verdict.scene = name;
  verdict.family = family;
  Trial(verdict, options).run(text);
  return verdict;
}

}  // namespace boresight::gauntlet
