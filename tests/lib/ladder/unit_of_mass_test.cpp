// In which unit masses are measured is nobody's error: with all that has a kilogram in it 4,096 times as large, and so every force, nothing
// moves otherwise. A power of two changes no digit, so that what differs by more than rounding is a bound with a unit that nobody gave it.
#include <gtest/gtest.h>

#include <filesystem>

#include "boresight/contact_events/contact_report.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "scenes.hpp"

namespace boresight {
namespace unit_of_mass_test {

constexpr double kTimes = 4096.0;

class Times final : public TimeFunction {
 public:
  explicit Times(TimeFunctionPtr force) : force_(std::move(force)) {}
  TimeValue at(double t) const override {
    const TimeValue f = force_->at(t);
    return {kTimes * f.value, kTimes * f.rate, kTimes * f.acceleration};
  }

 private:
  TimeFunctionPtr force_;
};

MechanismDescription heavier(MechanismDescription d) {
  for (BodyDescription& b : d.bodies) {
    b.mass *= kTimes;
    b.inertia *= kTimes;
  }
  if (d.payload) d.payload->mass *= kTimes;
  for (ClearanceDescription& c : d.clearances) {
    ContactParameters& k = c.parameters.contact;
    for (double& young : k.young) young *= kTimes;
    k.density *= kTimes;
    k.linear_stiffness *= kTimes;
    k.linear_damping *= kTimes;
  }
  for (SpringDescription& s : d.springs) {
    s.parameters.stiffness *= kTimes;
    s.parameters.damping *= kTimes;
    s.parameters.preload *= kTimes;
  }
  for (LoadDescription& l : d.loads) {
    if (l.along_joint) l.along_joint = std::make_shared<Times>(l.along_joint);
    for (TimeFunctionPtr& f : l.force)
      if (f) f = std::make_shared<Times>(f);
  }
  return d;
}

// Of what a rung answers, or that it does not.
std::vector<double> answers(const std::string& rung, const std::shared_ptr<const Mechanism>& mechanism, double force) {
  RunOptions options;
  options.sample_spacing = 0.0;
  options.events = false;
  std::vector<double> all;
  try {
    const RunResult result = make_rung(rung, mechanism)->run(mechanism->parameters(), options);
    for (const auto quantity : {PointingQuantity::position_error, PointingQuantity::orientation_error}) {
      for (const auto statistic : {&Statistics::max, &Statistics::rms, &Statistics::mean})
        all.push_back(result.index.of(quantity).*statistic);
      all.push_back(result.error.model_of(quantity));
    }
    for (const ContactSummary& c : result.contact)
      all.insert(all.end(), {c.max_load / force, c.max_force / force, c.max_penetration, c.contact_fraction});
  } catch (const ComputationError&) {
  }
  return all;
}

void hold(const std::string& name, MechanismDescription d, const std::vector<std::string>& rungs) {
  d.motion.duration = std::min(d.motion.duration, 0.005);
  const auto light = scenes::build(d), heavy = scenes::build(heavier(d));
  const std::vector<ContactFrequency> a = analyse_contacts(*light, light->parameters()),
                                      b = analyse_contacts(*heavy, heavy->parameters());
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t c = 0; c < a.size(); ++c) {
    const std::string where = name + ", " + a[c].joint;
    EXPECT_NEAR(b[c].largest_load, kTimes * a[c].largest_load, 1e-9 * b[c].largest_load) << where;
    EXPECT_NEAR(b[c].typical_load, kTimes * a[c].typical_load, 1e-9 * b[c].typical_load) << where;
    EXPECT_NEAR(b[c].effective_mass, kTimes * a[c].effective_mass, 1e-9 * b[c].effective_mass) << where;
    EXPECT_NEAR(b[c].largest_stable_step, a[c].largest_stable_step, 1e-9 * a[c].largest_stable_step) << where;
  }
  for (const std::string& rung : rungs) {
    const std::vector<double> own = answers(rung, light, 1.0), other = answers(rung, heavy, kTimes);
    ASSERT_EQ(own.size(), other.size()) << name << ", " << rung;
    for (std::size_t i = 0; i < own.size(); ++i)
      EXPECT_NEAR(own[i], other[i], 1e-9 * std::abs(own[i]) + 1e-16) << name << ", " << rung << ", number " << i;
  }
}

TEST(UnitOfMass, ChangesNothingOnTheGauntletsArchetypes) {
  int scenes = 0;
  for (const auto& file : std::filesystem::directory_iterator(BORESIGHT_CORPUS)) {
    if (file.path().extension() != ".toml") continue;
    hold(file.path().filename(), read_mechanism(file.path(), {}), {"quasistatic", "perturbation"});
    ++scenes;
  }
  EXPECT_GT(scenes, 35);
}

TEST(UnitOfMass, ChangesNothingWithPlayInTwelveJoints) {
  hold("twelve joints", read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/3-rrcpr/twelve-joints.toml"),
       {"quasistatic", "perturbation"});
}

}  // namespace unit_of_mass_test
}  // namespace boresight
