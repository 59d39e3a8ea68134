// How the pointing error follows from the gaps where journals rest against their sleeves, and from the standing
// errors of the parts: linearly, instant by instant,
//
//   e(t) = e_0(t) + sum_j a_j(t) c_j,        index = statistic over t of |e(t)|
//
// with one vector a_j per gap: where its journal lies under the ideal reaction, carried to the boresight
// body; and one per standing error: its column of influence (boresight/scene/standing_errors.hpp), exact to
// first order. e_0 holds what hangs on neither (deflections, axial play). The gaps' are taken from runs of the
// quasistatic rung, whose contact directions come from the ideal motion and not from the gaps; so the form is
// its own, up to the second order of c. Where redundant joints tie plays together the directions do hang on the
// gaps: `misfit` says by how much, and beyond kMostMisfit (allocation.hpp) nothing is proven by the form.
//
// The index is a convex function of the c for every statistic but p99.73; its gradient then gives lower
// bounds that hold everywhere, by which the allocation proves that nothing cheaper exists. |e(t)| is convex at
// each instant whatever the statistic, and no statistic falls where no size does: that bounds p99.73.
//
// Gaps may work against each other: a wider one can point better. An error does so whenever its sign is the
// other one. Nothing here is taken to rise with the c unless `rises_with_every_gap` has found it.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight/mechanism/parameter_path.hpp"
#include "boresight_analyses/study/index_choice.hpp"

namespace boresight {

class LinearDeviation {
 public:
  // offset[3 i + d], sensitivity[j][3 i + d]: component d at instant i, [m] or [rad], and per m of gap j or SI
  // unit of error j;
  // `time`: of the instants, ascending. `statistic` among statistic_names().
  LinearDeviation(std::vector<double> time, std::vector<double> offset, std::vector<std::vector<double>> sensitivity,
                  std::string statistic);

  std::size_t gaps() const { return sensitivity_.size(); }
  // Of these of its gaps and errors, the others being zero.
  LinearDeviation of_only(const std::vector<std::size_t>& kept) const;
  double most_per_gap(std::size_t j) const;  // the largest |a_j| over time
  double alone(std::size_t j) const {
    return statistic_of(size_[j], nullptr);
  }  // the index of c_j = 1 and nothing else
  bool is_convex() const { return statistic_ != "p99.73"; }

  double index(std::span<const double> gaps) const;
  // And its gradient per gap (a subgradient where there is a kink).
  double index(std::span<const double> gaps, std::span<double> gradient) const;
  // A lower bound of the index over all gaps between `low` and `high`, for every statistic, from the tangents of
  // |e| at `at`, instant by instant.
  double least_index(std::span<const double> at, std::span<const double> low, std::span<const double> high) const;
  // Whether |e| falls nowhere between `low` and `high` as any c_j that may widen does, at no instant:
  // e(t) . a_j(t) >= 0 throughout. Sufficient for the index to rise with every one of them.
  bool rises_with_every_gap(std::span<const double> low, std::span<const double> high) const;
  // With all in one direction at every instant: statistic of |e_0| + sum |a_j| c_j, of sizes c_j >= 0.
  double worst_index(std::span<const double> gaps) const;
  double worst_index(std::span<const double> gaps, std::span<double> gradient) const;

 private:
  // The statistic of these sizes and the weight of each instant in its derivative.
  double statistic_of(const std::vector<double>& sizes, std::vector<double>* derivative) const;

  std::vector<double> time_, offset_, weight_;           // weight: share of the motion that an instant stands for
  std::vector<std::vector<double>> sensitivity_, size_;  // |a_j| per instant
  std::vector<double> offset_size_;
  std::string statistic_;
};

// `places`: one radial clearance each, or several that share a value; or one standing error, or several that do. `instants`: kept of what
// the index counts, from its start on; drawn from stretches of the motion where it is faster than they are. What the linear
// form misses against the rung itself, relative, is measured with all at `probe`, none of them zero, with every other one
// narrow, and with each alone; the largest is returned in `misfit`. `left_out`: which places may be left out, where play takes up
// the error that they name and no linear form holds; then, which were. Throws ComputationError, also where an error strains the
// mechanism, or is taken up and may not be left out.
LinearDeviation find_linear_deviation(const std::shared_ptr<const Mechanism>& mechanism,
                                      const std::vector<std::vector<ParameterPath>>& places,
                                      const std::vector<double>& probe, const IndexChoice& index, std::size_t instants,
                                      double& misfit, std::vector<bool>* left_out = nullptr);

}  // namespace boresight
