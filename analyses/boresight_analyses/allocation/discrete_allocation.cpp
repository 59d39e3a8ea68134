#include "boresight_analyses/allocation/discrete_allocation.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

namespace boresight {
namespace {

using Prices = std::vector<std::vector<double>>;

struct Node {
  double bound = 0.0;
  std::size_t depth = 0;  // joints decided, in the search's order
  std::vector<int> choice;
};
struct Dearer {
  bool operator()(const Node& l, const Node& r) const {
    return l.bound != r.bound ? l.bound > r.bound : l.depth < r.depth;
  }
};

class BranchAndBound {
 public:
  BranchAndBound(const Prices& price, const std::vector<int>& tightest, const AllocationRequirement& requirement,
                 const DiscreteAllocationOptions& options)
      : price_(price), tightest_(tightest), requirement_(requirement), options_(options) {
    // Joints whose price varies most decide most.
    for (std::size_t j = 0; j < price.size(); ++j) order_.push_back(j);
    const auto range = [&](std::size_t j) {
      const auto [low, high] = std::minmax_element(price_[j].begin(), price_[j].end());
      return *high - *low;
    };
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t l, std::size_t r) { return range(l) > range(r); });
  }

  DiscreteAllocation run() {
    if (options_.start.size() == price_.size()) offer(options_.start);
    offer(tightest_);
    add_inequalities(tightest_);
    if (result_.feasible) {
      try_multipliers();
      add_inequalities(result_.choice);
      try_multipliers();
      relax();
      add_inequalities(result_.choice);
    }
    Node root{0.0, 0, std::vector<int>(price_.size(), -1)};
    if (!requirement_.may_be_met(root.choice)) {
      result_.proven = true;
      result_.bound = std::numeric_limits<double>::infinity();
      return result_;
    }
    root.bound = bound_of(root);
    std::priority_queue<Node, std::vector<Node>, Dearer> open;
    open.push(root);
    while (!open.empty()) {
      const Node node = open.top();
      open.pop();
      result_.bound = node.bound;
      if (!cheaper(node.bound)) break;
      if (++result_.nodes > options_.most_nodes) return result_;
      if (options_.progress && result_.nodes % 64 == 0 && !options_.progress(result_)) return result_;
      expand(node, open);
    }
    result_.proven = true;
    result_.bound = result_.feasible ? result_.price : std::numeric_limits<double>::infinity();
    return result_;
  }

 private:
  // Any price, while no set is known.
  bool cheaper(double price) const {
    return !result_.feasible || price < result_.price - kRoundingOfPrices * std::abs(result_.price);
  }

  bool offer(const std::vector<int>& choice) {
    const double price = price_of(price_, choice);
    if (result_.feasible && !cheaper(price)) return false;
    ++result_.judged;
    if (!requirement_.is_met(choice)) return false;
    result_.feasible = true;
    result_.price = price;
    result_.choice = choice;
    return true;
  }

  // From a set that meets the requirement: the cheapest set that differs in one joint's option, or in two,
  // and meets it too, until there is none.
  void relax() {
    for (bool better = true; better;) {
      better = false;
      std::vector<std::pair<double, std::vector<int>>> tries;
      const auto each = [&](std::vector<int> choice, std::size_t from, auto&& visit) {
        for (std::size_t j = from; j < price_.size(); ++j)
          for (int o = 0; o < static_cast<int>(price_[j].size()); ++o) {
            if (o == choice[j]) continue;
            std::vector<int> changed = choice;
            changed[j] = o;
            visit(changed, j);
          }
      };
      const auto add = [&](const std::vector<int>& choice, std::size_t) {
        const double price = price_of(price_, choice);
        if (cheaper(price)) tries.emplace_back(price, choice);
      };
      each(result_.choice, 0, [&](const std::vector<int>& one, std::size_t j) {
        add(one, j);
        each(one, j + 1, add);
      });
      // Small savings are the likeliest to hold; a run of failures ends the round.
      std::stable_sort(tries.begin(), tries.end(), [](const auto& l, const auto& r) { return l.first > r.first; });
      constexpr int kMostTries = 400;
      int left = kMostTries;
      for (const auto& [price, choice] : tries) {
        if (left-- == 0) break;
        if (!cheaper(price) || may_not(choice) || !offer(choice)) continue;
        better = true;
        break;
      }
    }
  }

  // Whether asking the requirement can pay: where the open joints' least weights leave an inequality far from
  // its budget, the answer is yes.
  bool is_tight(const Node& node) const {
    if (inequalities_.empty()) return true;
    constexpr double kClose = 0.97;
    for (const AdditiveInequality& inequality : inequalities_) {
      double sum = 0.0;
      for (std::size_t j = 0; j < price_.size(); ++j)
        sum += node.choice[j] >= 0 ? inequality.weight[j][static_cast<std::size_t>(node.choice[j])]
                                   : *std::min_element(inequality.weight[j].begin(), inequality.weight[j].end());
      if (sum > kClose * inequality.budget) return true;
    }
    return false;
  }

  // An inequality rules the set out already.
  bool may_not(const std::vector<int>& choice) const {
    for (const AdditiveInequality& inequality : inequalities_) {
      double sum = 0.0;
      for (std::size_t j = 0; j < choice.size(); ++j) sum += inequality.weight[j][static_cast<std::size_t>(choice[j])];
      if (sum > inequality.budget + 1e-9 * std::abs(inequality.budget)) return true;
    }
    return false;
  }

  void add_inequalities(const std::vector<int>& near) {
    constexpr std::size_t kMost = 9;
    for (AdditiveInequality& inequality : requirement_.inequalities_near(near)) {
      if (inequalities_.size() >= kMost) return;
      inequalities_.push_back(std::move(inequality));
    }
  }

  // Sets that the multipliers of the inequalities suggest: of each, the options that are cheapest with their
  // weights priced.
  void try_multipliers() {
    std::vector<std::pair<double, std::vector<int>>> tries;
    for (const AdditiveInequality& inequality : inequalities_) {
      const auto [least, largest] = multipliers_of(inequality);
      for (double decade = least; decade < largest; decade += 0.02) {
        const double lambda = std::pow(10.0, decade);
        std::vector<int> choice;
        for (std::size_t j = 0; j < price_.size(); ++j) {
          std::size_t best = 0;
          for (std::size_t o = 1; o < price_[j].size(); ++o)
            if (price_[j][o] + lambda * inequality.weight[j][o] < price_[j][best] + lambda * inequality.weight[j][best])
              best = o;
          choice.push_back(static_cast<int>(best));
        }
        tries.emplace_back(price_of(price_, choice), std::move(choice));
      }
    }
    std::sort(tries.begin(), tries.end());
    tries.erase(std::unique(tries.begin(), tries.end()), tries.end());
    for (const auto& [price, choice] : tries)
      if (offer(choice)) break;
  }

  // From and to what power of ten multipliers are of interest: four to either side of the largest price over the largest weight, and
  // further down where some joint's own are smaller, so that cheap joints have their say beside dear ones.
  std::pair<double, double> multipliers_of(const AdditiveInequality& inequality) const {
    constexpr double kAround = 4.0, kOfOneJoint = 1.0;
    double price = 0.0, weight = 0.0, least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < price_.size(); ++j) {
      const auto [cheap, dear] = std::minmax_element(price_[j].begin(), price_[j].end());
      const auto [low, high] = std::minmax_element(inequality.weight[j].begin(), inequality.weight[j].end());
      price = std::max(price, *dear - *cheap);
      weight = std::max(weight, *high - *low);
      if (*dear > *cheap && *high > *low) least = std::min(least, (*dear - *cheap) / (*high - *low));
    }
    if (!(price > 0.0) || !(weight > 0.0)) return {0.0, 0.0};
    const double middle = std::log10(price / weight);
    return {std::min(middle - kAround, std::log10(least) - kOfOneJoint), middle + kAround};
  }

  double bound_of(const Node& node) const {
    double decided = 0.0, least = 0.0;
    for (std::size_t j = 0; j < price_.size(); ++j)
      if (node.choice[j] >= 0)
        decided += price_[j][static_cast<std::size_t>(node.choice[j])];
      else
        least += *std::min_element(price_[j].begin(), price_[j].end());
    double bound = decided + least;
    for (const AdditiveInequality& inequality : inequalities_)
      bound = std::max(bound, decided + priced(inequality, node));
    return bound;
  }

  // max over lambda >= 0 of sum over open joints of min_o (price + lambda weight) - lambda (budget - decided
  // weight): a concave function of lambda, its maximum by golden section. Infinite where even the least
  // weights exceed the budget.
  double priced(const AdditiveInequality& inequality, const Node& node) const {
    double left = inequality.budget, least_weight = 0.0, price_range = 0.0, weight_range = 0.0;
    for (std::size_t j = 0; j < price_.size(); ++j) {
      const auto& w = inequality.weight[j];
      if (node.choice[j] >= 0) {
        left -= w[static_cast<std::size_t>(node.choice[j])];
        continue;
      }
      const auto [low, high] = std::minmax_element(w.begin(), w.end());
      least_weight += *low;
      weight_range = std::max(weight_range, *high - *low);
      const auto [cheap, dear] = std::minmax_element(price_[j].begin(), price_[j].end());
      price_range = std::max(price_range, *dear - *cheap);
    }
    if (least_weight > left + 1e-12 * std::abs(inequality.budget)) return std::numeric_limits<double>::infinity();
    if (weight_range == 0.0) return -std::numeric_limits<double>::infinity();
    const auto dual = [&](double lambda) {
      double sum = -lambda * left;
      for (std::size_t j = 0; j < price_.size(); ++j) {
        if (node.choice[j] >= 0) continue;
        double best = std::numeric_limits<double>::infinity();
        for (std::size_t o = 0; o < price_[j].size(); ++o)
          best = std::min(best, price_[j][o] + lambda * inequality.weight[j][o]);
        sum += best;
      }
      return sum;
    };
    // Logarithmic in lambda: its natural size is price over weight, over some decades.
    double low = std::log(price_range / weight_range + 1e-300) - 7.0, high = low + 14.0;
    constexpr double kGolden = 0.6180339887498949;
    double x1 = high - kGolden * (high - low), x2 = low + kGolden * (high - low);
    double y1 = dual(std::exp(x1)), y2 = dual(std::exp(x2)), best = std::max({dual(0.0), y1, y2});
    for (int i = 0; i < 30; ++i) {
      if (y1 < y2) {
        low = x1, x1 = x2, y1 = y2;
        x2 = low + kGolden * (high - low);
        y2 = dual(std::exp(x2));
      } else {
        high = x2, x2 = x1, y2 = y1;
        x1 = high - kGolden * (high - low);
        y1 = dual(std::exp(x1));
      }
      best = std::max({best, y1, y2});
    }
    return best;
  }

  void expand(const Node& node, std::priority_queue<Node, std::vector<Node>, Dearer>& open) {
    if (node.depth == price_.size()) {
      if (offer(node.choice)) {
        relax();
        add_inequalities(result_.choice);
      }
      return;
    }
    const std::size_t joint = order_[node.depth];
    for (int o = 0; o < static_cast<int>(price_[joint].size()); ++o) {
      Node child{0.0, node.depth + 1, node.choice};
      child.choice[joint] = o;
      child.bound = std::max(node.bound, bound_of(child));
      if (!cheaper(child.bound)) continue;
      if (child.depth < price_.size() && is_tight(child) && !requirement_.may_be_met(child.choice)) continue;
      // A set that meets the requirement, early: the open joints at their tightest.
      if (!result_.feasible) {
        std::vector<int> whole = child.choice;
        for (std::size_t j = 0; j < whole.size(); ++j)
          if (whole[j] < 0) whole[j] = tightest_[j];
        if (offer(whole)) relax();
      }
      open.push(std::move(child));
    }
  }

  const Prices& price_;
  const std::vector<int>& tightest_;
  const AllocationRequirement& requirement_;
  const DiscreteAllocationOptions& options_;
  std::vector<std::size_t> order_;
  std::vector<AdditiveInequality> inequalities_;
  DiscreteAllocation result_;
};

}  // namespace

double price_of(const Prices& price, std::span<const int> choice) {
  double sum = 0.0;
  for (std::size_t j = 0; j < price.size(); ++j) sum += price[j][static_cast<std::size_t>(choice[j])];
  return sum;
}

DiscreteAllocation allocate_discrete(const Prices& price, const std::vector<int>& tightest,
                                     const AllocationRequirement& requirement,
                                     const DiscreteAllocationOptions& options) {
  return BranchAndBound(price, tightest, requirement, options).run();
}

}  // namespace boresight
