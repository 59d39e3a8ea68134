// The cheapest set of options, one per joint, that meets a requirement: branch and bound, exact.
//
// A node decides some joints. It is left when no completion of it can meet the requirement, or when none can
// be cheaper than the best set known: the least price of the joints left open, also under the additive
// inequality that the requirement offers,
//   sum_j w_j(o_j) <= budget    for every set that meets it,
// priced by its Lagrange multiplier (Fisher 1981, Management Science 27, "The Lagrangian relaxation method";
// any multiplier gives a bound, the best one is sought). Nodes are taken cheapest bound first.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace boresight {

// weight[joint][option].
struct AdditiveInequality {
  std::vector<std::vector<double>> weight;
  double budget = 0.0;
};

class AllocationRequirement {
 public:
  virtual ~AllocationRequirement() = default;
  // choice[j]: the option of joint j.
  virtual bool is_met(std::span<const int> choice) const = 0;
  // choice[j] = -1: open. May say true in error, never false.
  virtual bool may_be_met(std::span<const int> choice) const = 0;
  // Hold for every set that meets the requirement; sharpest for sets near `choice`.
  virtual std::vector<AdditiveInequality> inequalities_near(std::span<const int>) const { return {}; }
};

struct DiscreteAllocation {
  bool feasible = false;
  bool proven = false;      // nothing cheaper exists, or nothing meets the requirement at all
  std::vector<int> choice;  // where feasible
  double price = std::numeric_limits<double>::infinity();
  double bound = 0.0;                  // nothing costs less and meets the requirement
  std::int64_t nodes = 0, judged = 0;  // judged: whole sets that the requirement was asked about
};

struct DiscreteAllocationOptions {
  std::int64_t most_nodes = 2'000'000;
  std::vector<int> start = {};                                   // a set to begin with, or empty
  std::function<bool(const DiscreteAllocation&)> progress = {};  // now and then; return false to stop
};

// price[joint][option]; tightest[joint]: the option with the least gap.
DiscreteAllocation allocate_discrete(const std::vector<std::vector<double>>& price, const std::vector<int>& tightest,
                                     const AllocationRequirement& requirement,
                                     const DiscreteAllocationOptions& options = {});

double price_of(const std::vector<std::vector<double>>& price, std::span<const int> choice);

// Prices are sums of some tens of numbers: what differs by less than this share of them differs by rounding. No more, for what is to
// be saved may be small beside what has to be paid anyhow.
inline constexpr double kRoundingOfPrices = 1e-13;

}  // namespace boresight
