// Where a slider rests in its guide under a force and, where it may tilt, couples on its slopes and its roll.
//
//   parallel   |e_x| = c_x + |F_x| / K_x, |e_z| likewise                              Hooke
//   tilting    where the contacts' elastic energy less the work of the load is least: it is convex, each penetration being linear in the
//              offsets, and its second derivatives are those of SliderInGuide::tangent(). Found by Newton's method, damped as Levenberg and
//              Marquardt do, from where the slider was: what no force moves stays.
#include <algorithm>
#include <cmath>

#include "boresight/play/guide/slider_in_guide.hpp"
#include "boresight/play/search_for_rest.hpp"

namespace boresight {
namespace {

using SliderStiffness = Eigen::Matrix<double, kMostOffsets, kMostOffsets>;

class PressedSlider {
 public:
  PressedSlider(const SliderInGuide& slider, const PlayOffsets& load) : slider_(slider), load_(load) {
    const double lever = slider.half_length;
    unit_ << 1.0, 1.0, 1.0, 1.0 / lever, 1.0 / lever, 1.0 / lever;
    load_[1] = 0.0;
    size_ = load_.cwiseProduct(unit_).norm();
  }

  PlayOffsets rest_near(PlayOffsets at) {
    const double room = std::max({slider_.gap[0], slider_.gap[1], size_ / slider_.law.stiffness});
    double damping = size_ > 0.0 ? size_ / room : slider_.law.stiffness;
    set(at);
    for (int k = 0; k < rest::kIterations && gradient_.norm() > rest::kBalance * size_; ++k) {
      const double value = value_, residual = gradient_.norm();
      SliderStiffness damped = curvature_;
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
    const PlayMotion<double> motion = at_rest_at(offsets);
    value_ = slider_.elastic_energy(motion) - load_.dot(offsets);
    gradient_ = -(load_ + slider_.elastic_force(motion)).cwiseProduct(unit_);
    curvature_.setZero();
    const ContactTangent tangent = slider_.tangent(motion);
    for (int k = 0; k < tangent.count; ++k) curvature_ += tangent.column[k].n * tangent.column[k].n.transpose();
    curvature_ = unit_.asDiagonal() * curvature_ * unit_.asDiagonal();
  }

  const SliderInGuide& slider_;
  PlayOffsets load_, unit_, gradient_;
  SliderStiffness curvature_;
  double size_ = 0.0, value_ = 0.0;
};

}  // namespace

RestingPlay SliderInGuide::rest_under(const PlayOffsets& load, double slide, const RestingPlay& before) const {
  RestingPlay rest;
  PlayOffsets at = offsets_of(before.motion);
  if (tilts) {
    at = PressedSlider(*this, load).rest_near(at);
  } else {
    at.setZero();
    for (const int across : {0, 1}) {
      const double force = load[2 * across], reach = gap[across] + std::abs(force) / stiffness[across];
      at[2 * across] = force != 0.0 ? std::copysign(reach, force)
                                    : std::clamp(before.motion.e[2 * across], -gap[across], gap[across]);
    }
  }
  at[1] = slide;
  rest.motion = at_rest_at(at);
  const SliderInGuide elastic = elastic_only();
  PlayWrench<double> wrench;
  elastic.wrench(rest.motion, kSlowImpacts, SlidingFriction<double>{elastic.friction}, wrench);
  rest.contact = wrench.contact;
  return rest;
}

}  // namespace boresight
