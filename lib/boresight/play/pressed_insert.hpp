// Where an insert between faces rests, each of whose penetrations is linear in its offsets: where the contacts' elastic energy less the work of
// the load is least. That is convex, and its second derivatives are those of tangent(). Found by Newton's method, damped as Levenberg and
// Marquardt do, from where the insert was: what no force moves stays.
//
// Kind: of play_kind.hpp, with elastic_force(motion) besides, what its elastic contacts push the offsets by.
#pragma once

#include <algorithm>
#include <cmath>

#include "boresight/play/play_kind.hpp"
#include "boresight/play/search_for_rest.hpp"

namespace boresight {

template <typename Kind>
class PressedInsert {
 public:
  // load: on the offsets that play frees, zero on the others [N, N m].
  PressedInsert(const Kind& insert, const PlayOffsets& load, const JointCoordinates& joint)
      : insert_(insert), joint_(joint), load_(load) {
    const double lever = insert.lever();
    unit_ << 1.0, 1.0, 1.0, 1.0 / lever, 1.0 / lever, 1.0 / lever;
    size_ = load_.cwiseProduct(unit_).norm();
  }

  PlayOffsets rest_near(PlayOffsets at) {
    const std::vector<double> gaps = insert_.clearances();
    const double stiffness = insert_.normal_law().stiffness;
    const double room = std::max(*std::max_element(gaps.begin(), gaps.end()), size_ / stiffness);
    double damping = size_ > 0.0 ? size_ / room : stiffness;
    set(at);
    for (int k = 0; k < rest::kIterations && gradient_.norm() > rest::kBalance * size_; ++k) {
      const double value = value_, residual = gradient_.norm();
      Stiffness damped = curvature_;
      damped.diagonal().array() += damping;
      const PlayOffsets step = -damped.ldlt().solve(gradient_);
      const PlayOffsets next = at + unit_.cwiseProduct(step);
      set(next);
      const double rounding = 1e-12 * (std::abs(value) + size_ * room);
      if (value_ < value - rounding || (value_ <= value + rounding && gradient_.norm() < residual)) {
        at = next;
        damping *= 0.1;
      } else {
        damping = std::max(10.0 * damping, 1e-6 * size_ / room);
        set(at);
      }
      if (step.norm() <= rest::kShortestStep * room) break;
    }
    return at;
  }

 private:
  void set(const PlayOffsets& offsets) {
    const PlayMotion<double> motion = at_rest_at(offsets, joint_);
    value_ = insert_.elastic_energy(motion) - load_.dot(offsets);
    gradient_ = -(load_ + insert_.elastic_force(motion)).cwiseProduct(unit_);
    curvature_.setZero();
    const ContactTangent tangent = insert_.tangent(motion);
    for (int k = 0; k < tangent.count; ++k) curvature_ += tangent.column[k].n * tangent.column[k].n.transpose();
    curvature_ = unit_.asDiagonal() * curvature_ * unit_.asDiagonal();
  }

  using Stiffness = Eigen::Matrix<double, kMostOffsets, kMostOffsets>;

  const Kind& insert_;
  const JointCoordinates joint_;
  PlayOffsets load_, unit_, gradient_;
  Stiffness curvature_;
  double size_ = 0.0, value_ = 0.0;
};

}  // namespace boresight
