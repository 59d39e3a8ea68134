// What a set of tolerances has to meet, three ways of judging the same linear deviation:
//
//   statistical      P(index <= limit) >= p with confidence, over samples of the gaps (common to all sets)
//   worst case       every gap and error at its largest and all in one direction stay within the limit
//   root-sum-square  index at the middles of all zones + z sqrt(sum (s_j h_j / 3)^2) <= limit,
//                    h_j half the zone taken as three standard deviations, z the normal quantile of p (Chase,
//                    Greenwood 1988, "Design issues in mechanical tolerance analysis", Manufacturing Review 1(1)).
//                    s_j is dI/dc_j of a gap; of an error, which has no direction of its own against the
//                    others, the index of one unit of it alone, as pointing budgets add them. Where all are such errors the index is the
//                    size of what goes to both sides of nothing: z is then that of (1 + p) / 2
#pragma once

#include <cstdint>
#include <vector>

#include "boresight_analyses/allocation/discrete_allocation.hpp"
#include "boresight_analyses/allocation/linear_deviation.hpp"
#include "boresight_analyses/random/distribution.hpp"

namespace boresight {

// How many of `samples` may exceed the limit while P(index <= limit) >= probability still holds with this
// confidence (Clopper, Pearson); -1 if not even none is enough.
std::int64_t allowed_failures(std::int64_t samples, double probability, double confidence);

// unit[joint][sample] in (0, 1): the same for every set of options.
using UnitSamples = std::vector<std::vector<double>>;
UnitSamples unit_samples(std::size_t joints, std::size_t samples, std::uint64_t seed);

// What scatters beside the entries that a set decides about, as the deviation has it behind them: [which][sample], of the search's
// samples. By the two rules of thumb it counts with the largest of these sizes, and with their mean and deviation.
using BesideValues = std::vector<std::vector<double>>;

class StatisticalRequirement final : public AllocationRequirement {
 public:
  // gap[joint][option]: how the radial clearance scatters.
  StatisticalRequirement(const LinearDeviation& deviation, const std::vector<std::vector<DistributionPtr>>& gap,
                         const UnitSamples& unit, std::int64_t allowed, double limit, BesideValues beside = {});

  bool is_met(std::span<const int> choice) const override;
  bool may_be_met(std::span<const int> choice) const override;
  std::vector<AdditiveInequality> inequalities_near(std::span<const int> choice) const override;

  void set_limit(double limit) { limit_ = limit; }
  double limit() const { return limit_; }
  std::vector<double> indices(std::span<const int> choice) const;  // of all samples
  // The least limit that this set meets: the largest index but the allowed ones.
  double reached(std::span<const int> choice) const;
  // Of an option in one of the samples.
  double gap(std::size_t joint, int option, std::size_t sample) const {
    return gap_[joint][static_cast<std::size_t>(option)][sample];
  }
  // Variance of the index that joint j's gap brings, to first order about the mean gaps, as shares of their
  // sum.
  std::vector<double> error_shares(std::span<const int> choice) const;

 private:
  // A lower bound of sample k's index over all completions of `choice`; c: its gaps with the open joints at
  // their tightest, g: room for a gradient.
  double least_of(std::span<const int> choice, std::span<const double> c, std::span<double> g, std::size_t k) const;
  // An upper bound of sample k's index that costs next to nothing.
  double quick_bound(std::span<const double> gaps, std::size_t k) const;
  // c: of sample k, all that the deviation is linear in, with the open joints at their tightest.
  void take(std::span<const int> choice, std::size_t k, std::vector<double>& c) const;
  std::size_t size() const { return gap_.size() + beside_.size(); }

  const LinearDeviation& deviation_;
  std::vector<std::vector<std::vector<double>>> gap_;  // [joint][option][sample]
  BesideValues beside_;
  std::vector<int> tightest_;
  std::size_t samples_;
  std::int64_t allowed_;
  double limit_;
  // At the tightest options: the index of each sample; and the most that joint j adds per metre of gap.
  std::vector<double> tight_index_, most_per_gap_;
  mutable std::vector<std::uint32_t> order_;  // samples, those that failed last first
};

// The option of each joint whose mean gap is least; of an error, where all zones have one middle, the narrowest.
std::vector<int> tightest_options(const std::vector<std::vector<DistributionPtr>>& gap);

class WorstCaseRequirement final : public AllocationRequirement {
 public:
  WorstCaseRequirement(const LinearDeviation& deviation, const std::vector<std::vector<DistributionPtr>>& gap,
                       double limit, const BesideValues& beside = {});
  bool is_met(std::span<const int> choice) const override;
  bool may_be_met(std::span<const int> choice) const override;
  std::vector<AdditiveInequality> inequalities_near(std::span<const int> choice) const override;

 private:
  const LinearDeviation& deviation_;
  std::vector<std::vector<double>> largest_;  // of sizes: an error's to either side
  std::vector<double> largest_beside_;
  double limit_;
};

// A rule of thumb to compare with. Open joints are taken at their tightest where the index was found to rise
// with every gap; elsewhere the index alone, without the root, bounds them from below.
class RootSumSquareRequirement final : public AllocationRequirement {
 public:
  // centred[j]: the zones of j lie about one middle, as those of errors do; none, if empty.
  RootSumSquareRequirement(const LinearDeviation& deviation, const std::vector<std::vector<DistributionPtr>>& gap,
                           double probability, double limit, std::vector<bool> centred = {},
                           const BesideValues& beside = {});
  bool is_met(std::span<const int> choice) const override;
  bool may_be_met(std::span<const int> choice) const override;

 private:
  double index_with_open_at_tightest(std::span<const int> choice) const;

  const LinearDeviation& deviation_;
  std::vector<std::vector<double>> middle_, half_;
  std::vector<double> least_, largest_;  // of the middles
  std::vector<double> middle_beside_, half_beside_;
  std::vector<int> tightest_;
  std::vector<bool> centred_;
  double z_, limit_;
  bool rises_ = false;  // with every gap: checked
};

// Half a zone whose mean and deviation a rule of thumb takes for those of these values: three standard deviations.
struct MiddleAndHalf {
  double middle = 0.0, half = 0.0;
};
MiddleAndHalf middle_and_half(const std::vector<double>& values);

// z of the root-sum-square rule.
double root_sum_square_quantile(double probability, const std::vector<bool>& centred, std::size_t count);

// index + z sqrt(sum (s_j half_j / 3)^2) at these gaps and errors; centred[j]: s_j is that of an error.
double root_sum_square_index(const LinearDeviation& deviation, std::span<const double> middle,
                             std::span<const double> half, double z, const std::vector<bool>& centred = {});

}  // namespace boresight
