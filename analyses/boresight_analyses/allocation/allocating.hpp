// One allocation under way: what run_allocation() goes through, round by round.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "boresight_analyses/allocation/allocation.hpp"
#include "boresight_analyses/allocation/gap_requirements.hpp"

namespace boresight {

class Allocating {
 public:
  Allocating(const AllocationPlan& plan, const LinearDeviation& deviation, const AllocationOptions& options);

  AllocationResult run(double misfit, const ConfirmingModel& confirm, const std::string& rung);

 private:
  struct Refuted {
    Allocation set;
    std::size_t confirmation = 0;  // which of them said so
  };

  void progress(const std::string& stage, double share) const;
  double working_limit(double limit) const { return limit / result_.factor; }

  // Entries with a cost curve, among others that have options, are searched in steps of their tolerance first ...
  void use_steps(Allocation& a) const;
  // ... and then let go of them: the tolerances of these entries at least price, the options of the others as they are.
  void refine(Allocation& a, double limit) const;
  // Whether what the search says of all sets holds of all sets: of a linear deviation, with nothing beside it that scatters and is
  // not in it.
  bool is_exact() const;
  double price_of_set(const Allocation& a) const;

  // The cheapest set by the samples of the search, for a limit on the confirming rung's scale.
  Allocation cheapest(double limit, const std::vector<int>& start = {});

  DistributionPtr zone_of(const Allocation& a, std::size_t j) const;
  // Gaps and errors of a set at these coordinates: [sample][entry].
  std::vector<std::vector<double>> gaps_of(const Allocation& a, const UnitSamples& unit, std::size_t count) const;
  // The linear inputs' values at these coordinates: [input][sample].
  BesideValues beside_of(const UnitSamples& unit, std::size_t count) const;
  // The linear deviation's index of each sample.
  std::vector<double> linear_of(const std::vector<std::vector<double>>& gaps, const BesideValues& beside) const;
  // The limit that the samples of the search hold tolerances of all entries to; least, z: of each.
  ToleranceRequirement statistical(std::vector<double> least, std::vector<std::vector<double>> z) const;

  // By the samples of the search, on the confirming rung's scale.
  void evaluate(Allocation& a) const;

  // The other random parameters of the same samples: [sample][parameter], coordinates.
  std::vector<std::vector<double>> others_of(const UnitSamples& unit, std::size_t count) const;

  // `factor`: what these samples say that it should be.
  AllocationConfirmation confirmed(const Allocation& a, const ConfirmingModel& confirm, const std::string& rung,
                                   double& factor) const;

  // The factor from a few samples of the rung on the gaps of one set: the mean ratio on the very same gaps.
  void find_first_factor(const Allocation& a, const ConfirmingModel& confirm);

  void search_rounds(const ConfirmingModel& confirm, const std::string& rung);

  // The linear deviation is that of journals at rest, which may be far off the confirming rung: before nothing is
  // said to do, the tightest gaps are tried on that rung itself; and where a wider gap may point better, what the
  // samples of the search find to point best. `a`: what the search found last.
  void try_what_points_best(const Allocation& a, const ConfirmingModel& confirm, const std::string& rung);

  Allocation tightest_like(const Allocation& a) const;

  // The set that reaches the least limit by the samples of the search, as far as changes of one joint at a time
  // find it; the tightest one where the index rises with every gap.
  Allocation best_like(const Allocation& a) const;

  std::vector<double> lowest_gap() const { return extreme_gaps(false); }
  std::vector<double> highest_gap() const { return extreme_gaps(true); }
  std::vector<double> extreme_gaps(bool highest) const;

  static bool same(const Allocation& a, const Allocation& b);
  // Its refutation; nullptr: none.
  const Refuted* refutation_of(const Allocation& a) const;

  // What the two classical ways of judging choose for the same limit, and how that fares by the samples.
  void compare();

  void share_out();

  void price_front();

  const AllocationPlan& plan_;
  const LinearDeviation& deviation_;
  const AllocationOptions& options_;
  UnitSamples unit_;
  BesideValues beside_;  // of the samples of the search
  std::int64_t allowed_;
  // Of each entry's options, or of the steps of its tolerance; empty where all entries have cost curves.
  std::vector<std::vector<double>> price_;
  std::vector<std::vector<DistributionPtr>> gap_;
  std::vector<std::vector<double>> step_;  // of tolerances; empty where there are options
  std::vector<int> tightest_;
  ZonePlaces places_;
  std::vector<ContinuousTolerance> curves_;
  std::vector<std::vector<double>> z_;
  std::unique_ptr<StatisticalRequirement> statistical_;
  std::vector<Refuted> refuted_;  // none of them is asked again
  AllocationResult result_;
};

}  // namespace boresight
