#include "boresight_analyses/stability/stability.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/stability/amplification.hpp"
#include "boresight_analyses/stability/contact_oscillator.hpp"

namespace boresight {
namespace {

constexpr double kZetas[] = {0.05, 0.1, 0.2, 0.3, 0.5, 0.7071, 0.8, 0.9, 1.0, 1.25, 1.5, 2.0, 3.0, 5.0};
constexpr int kGrowthCells = 33;
// The settled vibration's frequency against the mechanism's own; dropped from four rest depths, followed for
// 150 periods of the mechanism's own vibration.
constexpr double kSettledFactors[] = {0.25, 0.5, 1.0, 2.0, 4.0};
constexpr double kDropHeight = 4.0, kSettledPeriods = 150.0, kSettledTolerance = 1e-4;

struct Stopped {};

class Computation {
 public:
  Computation(const std::shared_ptr<const Mechanism>& mechanism, const StabilityOptions& options)
      : mechanism_(mechanism), options_(options) {
    scene_.mechanism = mechanism;
    scene_.reread = options.reread;
  }

  StabilityResult run() {
    try {
      next(0.0, "ideal motion and contacts");
      prepare();
      linear_contacts();
      settled_contacts();
      steps();
      baumgarte();
      next(0.55, "how long the motion can be foretold");
      if (scene_.followed && !scene_.contacts.empty())
        result_.separations = separations(*mechanism_, *followed_, {1e-12, 1e-9, 1e-6});
      cases();
    } catch (const Stopped&) {
      result_.interrupted = true;
    }
    return result_;
  }

 private:
  void next(double share, const std::string& what) {
    if (options_.progress && !options_.progress(share, what)) throw Stopped{};
  }
  // The same where a part of the work asks: false stops it, and the next next() ends the whole.
  std::function<bool()> advancing(double from, double to, int parts, const std::string& what) {
    return [this, from, to, parts, what, done = 0]() mutable {
      return !options_.progress || options_.progress(from + (to - from) * done++ / parts, what);
    };
  }

  void prepare() {
    try {
      ideal_.emplace(ideal_motion(*mechanism_, mechanism_->parameters()));
      scene_.ideal = &*ideal_;
      if (mechanism_->clearances() > 0) {
        scene_.contacts = analyse_contacts(*mechanism_, mechanism_->parameters(), *ideal_);
        // Plays that cannot move have no contacts to follow.
        if (std::all_of(scene_.contacts.begin(), scene_.contacts.end(),
                        [](const ContactFrequency& c) { return c.angular_frequency == 0.0; }))
          scene_.contacts.clear();
        result_.contacts = scene_.contacts;
      }
      followed_.emplace(follow(mechanism_));
      scene_.followed = &*followed_;
    } catch (const ComputationError& failure) {
      scene_.infeasible = failure.what();
      result_.warnings.emplace_back(failure.what());
    }
  }

  double own_frequency() const { return scene_.contacts[scene_.stiffest()].angular_frequency; }

  // Mass and frequency are the mechanism's stiffest contact's; where no joint has clearance, of one kilogram
  // at 1e4 rad/s: limits are the same for all.
  void linear_contacts() {
    next(0.05, "linear contacts");
    const bool own = scene_.stiffest() >= 0;
    const double mass = own ? scene_.contacts[scene_.stiffest()].effective_mass : 1.0,
                 omega = own ? own_frequency() : 1e4;
    for (const ExplicitTable* table : {&classical_rk4(), &dormand_prince54(), &bogacki_shampine32()}) {
      const MethodCoefficients method = coefficients(*table);
      // z: step times omega, step times c / m.
      const auto vibration = [&](double z) {
        return measured_growth(*table, ContactOscillator::of(mass, omega, 0.0), z / omega);
      };
      const auto damping = [&](double z) {
        return measured_growth(*table, {mass, 1e-9 * mass * omega * omega, mass * omega}, z / omega);
      };
      AxisLimit imaginary{table->name, "vibration", theoretical_limit(method, 0.0), 0.0};
      imaginary.measured = measured_limit(vibration, imaginary.theory);
      AxisLimit real{table->name, "damping", theoretical_limit(method, 1.0), 0.0};
      real.measured = measured_limit(damping, real.theory);
      result_.limits.push_back(imaginary);
      result_.limits.push_back(real);
    }
    for (const ExplicitTable* table : {&classical_rk4(), &dormand_prince54()}) {
      GrowthMap map{table->name, theoretical_limit(coefficients(*table), 0.0), {}, {}, {}};
      for (int i = 0; i < kGrowthCells; ++i) {
        const double share = i / (kGrowthCells - 1.0);
        map.frequency.push_back(0.1 * omega * std::pow(100.0, share));
        map.step.push_back(0.03 / omega * std::pow(300.0, share));
      }
      for (double h : map.step) {
        map.growth.emplace_back();
        for (double w : map.frequency)
          map.growth.back().push_back(measured_growth(*table, ContactOscillator::of(mass, w, 0.0), h));
      }
      result_.growth.push_back(std::move(map));
    }
  }

  void settled_contacts() {
    next(0.08, "contacts coming to rest");
    const int joint = scene_.stiffest();
    if (joint < 0) return;
    const SettlingContact own =
        SettlingContact::of(*mechanism_, mechanism_->parameters(), joint, scene_.contacts[joint]);
    const double duration = kSettledPeriods * 2.0 * std::numbers::pi / own.angular_frequency();
    for (double factor : kSettledFactors) {
      SettlingContact contact = own;
      contact.law.stiffness *=
          factor * factor * factor;  // omega goes with its cube root, of a spring with its square root
      SettledStep step{.frequency = contact.angular_frequency(), .pair = {}, .l_stable = {}};
      const double height = kDropHeight * contact.rest_depth();
      step.pair = stabilise(contact, height, duration, kSettledTolerance, true);
      step.l_stable = stabilise(contact, height, duration, kSettledTolerance, false);
      result_.settled.push_back(std::move(step));
    }
  }

  void steps() {
    if (!scene_.followed || scene_.contacts.empty()) return;
    result_.steps = map_steps(mechanism_, *followed_, options_.index,
                              advancing(0.1, 0.4, kStepMapColumns, "steps over contact frequencies"));
  }

  void baumgarte() {
    next(0.4, "Baumgarte's gains");
    if (!scene_.ideal) return;
    try {
      const BaumgarteDrift drift(*mechanism_, *ideal_);
      result_.baumgarte =
          map_baumgarte(drift, options_.cells, advancing(0.4, 0.5, options_.cells, "Baumgarte's gains"));
      next(0.5, "Baumgarte's limits");
      for (double zeta : kZetas) result_.baumgarte.limits.push_back(baumgarte_limit(drift, zeta));
    } catch (const ComputationError& failure) {
      result_.warnings.emplace_back(failure.what());
    }
  }

  void cases() {
    const auto add = [&](double share, const std::string& what, const auto& make) {
      next(share, what);
      result_.cases.push_back(make());
    };
    const Settling *pair = nullptr, *l_stable = nullptr;
    double omega = 0.0;
    for (const SettledStep& s : result_.settled) {
      if (&s != &result_.settled[result_.settled.size() / 2]) continue;
      pair = &s.pair, l_stable = &s.l_stable, omega = s.frequency;
    }
    add(0.6, "a step too large", [&] { return case_of_a_large_step(scene_); });
    add(0.65, "drift without stabilisation", [&] { return case_of_no_stabilisation(scene_); });
    add(0.8, "gains too large", [&] { return case_of_baumgarte_gains(result_.baumgarte); });
    add(0.8, "singular poses", [&] { return case_of_a_singular_pose(scene_); });
    add(0.85, "redundant rows", [&] { return case_of_redundant_rows(scene_); });
    add(0.87, "clearance towards zero", [&] { return case_of_vanishing_clearance(scene_); });
    add(0.9, "restitution towards zero", [&] { return case_of_vanishing_restitution(scene_); });
    add(0.9, "chatter",
        [&] { return case_of_chatter(scene_, pair ? *pair : Settling{}, l_stable ? *l_stable : Settling{}, omega); });
    add(0.9, "friction's creep", [&] { return case_of_creep(scene_); });
    add(0.9, "chaos", [&] { return case_of_chaos(scene_, result_.separations); });
    add(0.92, "large clearance", [&] { return case_of_large_clearance(scene_); });
  }

  std::shared_ptr<const Mechanism> mechanism_;
  const StabilityOptions& options_;
  Scene scene_;
  std::optional<IdealMotion> ideal_;
  std::optional<FollowedMotion> followed_;
  StabilityResult result_;
};

}  // namespace

const char* to_string(FailureCase::Standing standing) {
  switch (standing) {
    case FailureCase::Standing::behaves:
      return "behaves";
    case FailureCase::Standing::differs:
      return "differs";
    case FailureCase::Standing::not_here:
      return "not here";
  }
  return "";
}

int Scene::stiffest() const {
  int at = -1;
  for (std::size_t c = 0; c < contacts.size(); ++c)
    if (at < 0 || contacts[c].angular_frequency > contacts[at].angular_frequency) at = static_cast<int>(c);
  return at;
}

double StabilityResult::largest_difference() const {
  double worst = 0.0;
  for (const AxisLimit& l : limits) worst = std::max(worst, off_theory(l.measured, l.theory));
  for (const BaumgarteLimit& l : baumgarte.limits) worst = std::max(worst, off_theory(l.measured, l.theory));
  return worst;
}

StabilityResult find_stability(const std::shared_ptr<const Mechanism>& mechanism, const StabilityOptions& options) {
  return Computation(mechanism, options).run();
}

}  // namespace boresight
