// Screening by elementary effects (Morris 1991, Technometrics 33): which of many parameters matter at all, for few runs each.
//
// Each coordinate of the unit cube has p levels, the middles of p equal cells, (k + 1/2) / p. A row is a trajectory: it begins at
// random levels and moves one parameter (group) after the other, in random order, by half of the levels, so n rows of g groups
// cost n (g + 1) runs. As p is even, there is one way to move, and every level is as probable as any other all along. As p is a
// multiple of four, no move goes from u to 1 - u: such a mirror image about the median changes no magnitude of an error about
// zero, however much of the scatter it makes. With p = 4 k + 2 the move from level k is one, with p = 2 every move. The
// elementary effect of a move is
//
//   d = (y after - y before) / (u after - u before),   |u after - u before| = 1/2,
//
// the change of the result per whole range of the parameter's probabilities [unit of the result]. Over the trajectories
//
//   mu        mean of d                    what it does in one direction
//   mu_star   mean of |d|                  how much it does (Campolongo, Cariboni, Saltelli 2007)
//   sigma     standard deviation of d      how much that depends on where it and the others are: no straight line, or interactions
//
// Parameters of a group move together, each to its own side: it has a mu_star alone (the same paper).
// A row with a failed run is left out whole, and counted.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "boresight_analyses/random/parameter_groups.hpp"
#include "boresight_analyses/sensitivity/row_intervals.hpp"
#include "boresight_analyses/statistics/batch_model.hpp"

namespace boresight {

// The trajectories of a study.
class MorrisTrajectories {
 public:
  // levels: a multiple of four. Throws std::invalid_argument otherwise.
  MorrisTrajectories(ParameterGroups groups, int levels, std::uint64_t seed);

  std::uint64_t points() const { return groups_.size() + 1; }  // of a trajectory
  int levels() const { return levels_; }
  // Point `step` of trajectory `row`, in place of the uniform point where it begins (d coordinates).
  void place(std::uint64_t row, std::uint64_t step, std::span<double> start) const;
  // The elementary effects of the groups, in their order, from the results at all points; NaN where a result is not finite. `start`:
  // the uniform point.
  std::vector<double> effects(std::uint64_t row, std::span<const double> start, std::span<const double> results) const;

 private:
  int level(double u) const;
  std::uint64_t turn(std::size_t group, std::uint64_t row) const;  // which move is the group's, from 0

  ParameterGroups groups_;
  int levels_;
  std::uint64_t seed_;
};

// All trajectories from these uniform points in one batch: the effects, a row each.
std::vector<std::vector<double>> morris_rows(const BatchModel& model, const Points& starts,
                                             const MorrisTrajectories& trajectories);

template <typename Sampling>
struct MorrisEffects {
  struct Group {
    IntervalOf<Sampling> mu_star, mu, sigma;
  };
  std::vector<Group> groups;
  std::int64_t rows = 0, failed_rows = 0;
};

// Of rows of effects. Throw std::invalid_argument as row_intervals() does.
MorrisEffects<Independent> morris_effects(const std::vector<std::vector<double>>& rows,
                                          const BootstrapOptions& options);
MorrisEffects<Replicated> morris_effects(const std::vector<std::vector<std::vector<double>>>& replicates,
                                         double confidence);

}  // namespace boresight
