// Tolerances of standing errors beside the fits of joints, in one allocation.
#include <gmock/gmock.h>

#include <cmath>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight_analyses/allocation/allocation.hpp"
#include "boresight_analyses/allocation/gap_requirements.hpp"

namespace boresight {
namespace error_allocation_test {

// The default mechanism with the errors of its example, a short motion.
std::shared_ptr<const Mechanism> with_errors() {
  return std::make_shared<const Mechanism>(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/3-rrcpr/tolerances.toml", {{"motion.duration", "0.1 s"}}));
}

constexpr const char* kPaths[] = {"clearance.F1.radial", "error.rod1.length", "error.A2.zero", "error.C3.squareness"};

std::vector<std::vector<ParameterPath>> places_of(const Mechanism& mechanism) {
  std::vector<std::vector<ParameterPath>> places;
  for (const char* path : kPaths) places.push_back({ParameterPath(mechanism.description(), path)});
  return places;
}

// One joint with four fits, three errors with three grades each.
struct Small {
  std::shared_ptr<const Mechanism> mechanism = with_errors();
  std::vector<std::vector<double>> price = {{9, 6, 3, 1}, {8, 4, 1}, {12, 5, 1}, {7, 4, 2}};
  std::vector<std::vector<DistributionPtr>> zone;
  double misfit = 1.0;
  LinearDeviation deviation;
  UnitSamples unit = unit_samples(4, 200, 5);

  explicit Small(const std::string& statistic)
      : deviation(find_linear_deviation(mechanism, places_of(*mechanism), {0.05e-3, 10e-6, 50e-6, 50e-6},
                                        {"position_error", statistic}, 60, misfit)) {
    auto& gaps = zone.emplace_back();
    for (const double widest : {20e-6, 41e-6, 74e-6, 169e-6}) gaps.push_back(make_zone(5e-6, widest, ZoneLaw::normal));
    const auto errors = [&](std::initializer_list<double> tolerances) {
      auto& options = zone.emplace_back();
      for (const double t : tolerances) options.push_back(make_zone(-0.5 * t, t, ZoneLaw::normal));
    };
    errors({10e-6, 40e-6, 150e-6});
    errors({50e-6, 150e-6, 600e-6});
    errors({60e-6, 200e-6, 600e-6});
  }
};

std::vector<std::vector<int>> all_sets(const std::vector<std::vector<double>>& price) {
  std::vector<std::vector<int>> sets = {{}};
  for (const auto& options : price) {
    std::vector<std::vector<int>> longer;
    for (const auto& set : sets)
      for (int o = 0; o < static_cast<int>(options.size()); ++o) {
        longer.push_back(set);
        longer.back().push_back(o);
      }
    sets = longer;
  }
  return sets;
}

TEST(ErrorAllocation, NoSetOfFitsAndGradesIsCheaperByBruteForce) {
  int partly = 0;
  for (const char* statistic : {"max", "rms", "mean"}) {
    const Small s(statistic);
    for (const double limit : {0.04e-3, 0.07e-3, 0.1e-3, 0.15e-3, 0.2e-3}) {
      const StatisticalRequirement statistical(s.deviation, s.zone, s.unit, 6, limit);
      const WorstCaseRequirement worst(s.deviation, s.zone, limit);
      const RootSumSquareRequirement root(s.deviation, s.zone, 0.95, limit, {false, true, true, true});
      for (const AllocationRequirement* requirement :
           {static_cast<const AllocationRequirement*>(&statistical), static_cast<const AllocationRequirement*>(&worst),
            static_cast<const AllocationRequirement*>(&root)}) {
        double best = std::numeric_limits<double>::infinity();
        int meeting = 0, sets = 0;
        for (const std::vector<int>& choice : all_sets(s.price)) {
          ++sets;
          if (!requirement->is_met(choice)) continue;
          ++meeting;
          best = std::min(best, price_of(s.price, choice));
        }
        partly += meeting > 0 && meeting < sets;
        const DiscreteAllocation found = allocate_discrete(s.price, tightest_options(s.zone), *requirement);
        ASSERT_TRUE(found.proven);
        ASSERT_EQ(found.feasible, meeting > 0) << statistic << ' ' << limit;
        if (meeting == 0) continue;
        EXPECT_TRUE(requirement->is_met(found.choice));
        EXPECT_NEAR(found.price, best, 1e-9) << statistic << ' ' << limit;
      }
    }
  }
  EXPECT_GT(partly, 20);
}

// An error and a gap that scatter beside, of which no tolerance is asked: the sets are judged with their values, sample by sample.
TEST(ErrorAllocation, NoSetIsCheaperByBruteForceWhereOthersScatterBeside) {
  int partly = 0, other_than_alone = 0;
  for (const char* statistic : {"max", "rms", "p99.73"}) {
    const Small s(statistic);
    const std::vector<std::vector<double>> price(s.price.begin(), s.price.begin() + 2);
    const std::vector<std::vector<DistributionPtr>> zone(s.zone.begin(), s.zone.begin() + 2);
    const LinearDeviation tolerances_alone = s.deviation.of_only({0, 1});
    BesideValues beside(2);
    const DistributionPtr squareness = make_normal(0.0, 60e-6), zero = make_normal(20e-6, 80e-6);
    for (const double u : s.unit[2]) beside[0].push_back(zero->quantile(u));
    for (const double u : s.unit[3]) beside[1].push_back(squareness->quantile(u));
    for (const double limit : {0.1e-3, 0.115e-3, 0.13e-3, 0.15e-3, 0.17e-3, 0.2e-3, 0.23e-3, 0.27e-3}) {
      const StatisticalRequirement statistical(s.deviation, zone, s.unit, 6, limit, beside);
      const WorstCaseRequirement worst(s.deviation, zone, limit, beside);
      const RootSumSquareRequirement root(s.deviation, zone, 0.95, limit, {false, true}, beside);
      for (const AllocationRequirement* requirement :
           {static_cast<const AllocationRequirement*>(&statistical), static_cast<const AllocationRequirement*>(&worst),
            static_cast<const AllocationRequirement*>(&root)}) {
        double best = std::numeric_limits<double>::infinity();
        int meeting = 0, sets = 0;
        for (const std::vector<int>& choice : all_sets(price)) {
          ++sets;
          if (requirement == &statistical) {
            // By the samples themselves: no more than six above the limit.
            int above = 0;
            for (std::size_t k = 0; k < s.unit[0].size(); ++k)
              above += s.deviation.index(
                           std::vector<double>{zone[0][static_cast<std::size_t>(choice[0])]->quantile(s.unit[0][k]),
                                               zone[1][static_cast<std::size_t>(choice[1])]->quantile(s.unit[1][k]),
                                               beside[0][k], beside[1][k]}) > limit;
            ASSERT_EQ(requirement->is_met(choice), above <= 6) << statistic << ' ' << limit;
            const StatisticalRequirement alone(tolerances_alone, zone, s.unit, 6, limit);
            other_than_alone += alone.is_met(choice) != (above <= 6);
          }
          if (!requirement->is_met(choice)) continue;
          ++meeting;
          best = std::min(best, price_of(price, choice));
          for (const AdditiveInequality& i : requirement->inequalities_near(choice))
            for (const std::vector<int>& other : all_sets(price)) {
              if (!requirement->is_met(other)) continue;
              double sum = 0.0;
              for (std::size_t j = 0; j < other.size(); ++j) sum += i.weight[j][static_cast<std::size_t>(other[j])];
              ASSERT_LE(sum, i.budget + 1e-12 * std::abs(i.budget)) << statistic << ' ' << limit;
            }
        }
        partly += meeting > 0 && meeting < sets;
        const DiscreteAllocation found = allocate_discrete(price, tightest_options(zone), *requirement);
        ASSERT_TRUE(found.proven);
        ASSERT_EQ(found.feasible, meeting > 0) << statistic << ' ' << limit;
        if (meeting == 0) continue;
        EXPECT_NEAR(found.price, best, 1e-9) << statistic << ' ' << limit;
      }
    }
  }
  EXPECT_GT(partly, 10);
  EXPECT_GT(other_than_alone, 10);
}

// What sets that meet the requirement keep to, whatever they are.
TEST(ErrorAllocation, TheInequalitiesHoldForEverySetThatMeetsTheRequirement) {
  const Small s("max");
  const StatisticalRequirement statistical(s.deviation, s.zone, s.unit, 6, 0.1e-3);
  const WorstCaseRequirement worst(s.deviation, s.zone, 0.15e-3);
  int held = 0;
  for (const AllocationRequirement* requirement :
       {static_cast<const AllocationRequirement*>(&statistical), static_cast<const AllocationRequirement*>(&worst)}) {
    const auto inequalities = requirement->inequalities_near(std::vector<int>{1, 1, 1, 1});
    ASSERT_FALSE(inequalities.empty());
    for (const std::vector<int>& choice : all_sets(s.price)) {
      if (!requirement->is_met(choice)) continue;
      for (const AdditiveInequality& i : inequalities) {
        double sum = 0.0;
        for (std::size_t j = 0; j < choice.size(); ++j) sum += i.weight[j][static_cast<std::size_t>(choice[j])];
        EXPECT_LE(sum, i.budget + 1e-12 * std::abs(i.budget));
        ++held;
      }
    }
  }
  EXPECT_GT(held, 20);
}

// The linear form beside the rung itself, exact to second order, where it has not been tried.
TEST(ErrorAllocation, TheDeviationIsItsRungForErrorsOfEitherSign) {
  const auto mechanism = with_errors();
  const auto places = places_of(*mechanism);
  for (const char* quantity : {"position_error", "orientation_error", "boresight_error", "line_of_sight_error"}) {
    double misfit = 1.0;
    const IndexChoice index{quantity, "max"};
    // The gap stays what it was taken at: how far its contact gives way is not linear in it.
    const LinearDeviation found =
        find_linear_deviation(mechanism, places, {0.1e-3, 10e-6, 50e-6, 50e-6}, index, 400, misfit);
    const std::vector<double> at = {0.1e-3, -60e-6, 0.3e-3, -0.2e-3};
    Parameters p = mechanism->parameters();
    for (std::size_t j = 0; j < at.size(); ++j) places[j].front().set(p, at[j]);
    RunOptions options;
    options.events = false;
    options.sample_spacing = mechanism->duration() / 400;
    const double truth = index.of(make_rung("quasistatic", mechanism)->run(p, options).index);
    ASSERT_GT(truth, 0.0);
    EXPECT_NEAR(found.index(at) / truth, 1.0, 2e-3) << quantity;
  }
}

// Two errors in one direction and one across, alone on a mechanism that stands still: by hand.
TEST(ErrorAllocation, WorstCaseAndRootSumSquareAreThoseOfHalfZones) {
  const LinearDeviation deviation({0.0}, {0, 0, 0}, {{1, 0, 0}, {2, 0, 0}, {0, 3, 0}}, "max");
  const ZonePlaces places{.least = {0, 0, 0}, .centred = {true, true, true}};
  const std::vector<double> t = {2e-5, 4e-5, 2e-5};
  std::vector<double> gradient(3);
  EXPECT_NEAR(worst_case_tolerances(deviation, places)(t, gradient), 1e-5 + 2 * 2e-5 + 3 * 1e-5, 1e-15);
  EXPECT_THAT(gradient, testing::ElementsAre(0.5, 1.0, 1.5));
  // What is as likely to either side of nothing has a size: 95 % of it lie within 1.96 deviations, not 1.645.
  const double two_sided = 1.9599639845400545, one_sided = 1.6448536269514722;
  EXPECT_NEAR(root_sum_square_tolerances(deviation, places, 0.95)(t, {}),
              two_sided * std::hypot(1e-5 / 3, 2 * 2e-5 / 3, 3 * 1e-5 / 3), 1e-15);
  EXPECT_EQ(root_sum_square_quantile(0.95, {true, false, true}, 3), root_sum_square_quantile(0.95, {}, 3));
  EXPECT_NEAR(root_sum_square_quantile(0.95, {}, 3), one_sided, 1e-12);
}

// A fit to choose beside an error on a curve: the error's tolerance by the closed form, with the fit that is cheapest so.
TEST(ErrorAllocation, OfOptionsBesideACurveIsTheCheapestOfAllOptionsEachWithItsBestTolerance) {
  AllocationPlan plan;
  plan.samples = 400;
  plan.confirm = 120;
  plan.front = 0;
  plan.zone = ZoneLaw::uniform;
  plan.requirement = {.limit = 100e-6, .probability = 0.9, .confidence = 0.9};
  const auto mechanism = with_errors();
  const std::vector<std::pair<double, double>> fits = {{10e-6, 9.0}, {40e-6, 5.0}, {80e-6, 2.0}};  // gap, price
  AllocationEntry joint, error;
  joint.paths = {kPaths[0]};
  error.paths = {kPaths[1]};
  joint.places.emplace_back(mechanism->description(), kPaths[0]);
  error.places.emplace_back(mechanism->description(), kPaths[1]);
  for (const auto& [gap, price] : fits) joint.options.push_back({"fit", price, make_discrete({gap}, {1.0})});
  error.is_error = true;
  error.curve = {make_cost_curve("reciprocal", 0.0, 0.3, 1.0, 1e-3), 1e-6, 1e-3};
  plan.entries = {joint, error};
  // One direction: index = |c + e|; the gap is a constant, so each fit leaves the error what is left of the limit.
  const LinearDeviation deviation({0.0}, {0, 0, 0}, {{1, 0, 0}, {1, 0, 0}}, "max");
  const ConfirmingModel itself = [&](const auto& gaps, const auto&) {
    std::vector<Outcome> outcomes;
    for (const auto& g : gaps) {
      Outcome& o = outcomes.emplace_back();
      o.status = Outcome::Status::done;
      o.value = deviation.index(g);
    }
    return outcomes;
  };
  const AllocationResult found = run_allocation(plan, deviation, 0.0, itself, "itself", {});
  ASSERT_TRUE(found.feasible);
  EXPECT_FALSE(found.chosen.proven);  // of a curve nothing is
  ASSERT_EQ(found.chosen.tolerance.size(), 2u);
  // Of each fit, how wide the error may be: its largest value but the allowed ones reaches the limit.
  double best = std::numeric_limits<double>::infinity();
  const double z =
      (found.chosen.reached - fits[static_cast<std::size_t>(found.chosen.choice[0])].first) / found.chosen.tolerance[1];
  EXPECT_GT(z, 0.3);
  EXPECT_LT(z, 0.5);
  for (const auto& [gap, price] : fits)
    best = std::min(best, price + error.curve.cost.price(std::min(1e-3, (plan.requirement.limit - gap) / z)));
  EXPECT_NEAR(found.chosen.price / best, 1.0, 1e-3);
}

}  // namespace error_allocation_test
}  // namespace boresight
