#include "boresight/rungs/motion_recorder.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/mechanism/interruption.hpp"

namespace boresight {
namespace {

constexpr unsigned kStepsBetweenLooks = 256;  // at whether to go on

}  // namespace

MotionRecorder::MotionRecorder(const Mechanism& mechanism, const IdealMotion& ideal, const RunOptions& options,
                               double expected_steps)
    : mechanism_(mechanism),
      ideal_(ideal),
      spacing_(options.sample_spacing),
      frame_spacing_(options.frame_spacing),
      watched_(static_cast<bool>(options.progress)),
      bodies_of_sample_(options.pose_bodies),
      bodies_of_frame_(options.pose_bodies),
      start_(options.start),
      indices_(mechanism.pointing().line_of_sight.has_value(), options.start) {
  indices_.reserve(static_cast<std::size_t>(std::clamp(expected_steps, 16.0, 1e7)) + 2);
  result_.boresight.body = mechanism.boresight_body();
  result_.boresight.name = mechanism.description().bodies[mechanism.boresight_body()].name;
  for (int body : options.pose_bodies) {
    BodyHistory history;
    history.body = body;
    history.name = mechanism.description().bodies[body].name;
    result_.others.push_back(std::move(history));
  }
  for (int body = 0; body < mechanism.bodies(); ++body) bodies_of_frame_.push_back(body);
  result_.clearances.resize(mechanism.clearances());
}

PoseSample MotionRecorder::pose_sample(int body, const BodyMotion& motion, const BodyAcceleration& acceleration) const {
  BodyAcceleration ideal_acceleration;
  const BodyMotion ideal = ideal_.body(t_, body, &ideal_acceleration);
  PoseSample s;
  s.pose = {motion.p, Quat(motion.R)};
  s.ideal = {ideal.p, Quat(ideal.R)};
  s.error = pose_error(s.pose, s.ideal, mechanism_.pointing());
  s.v = motion.v;
  s.w = motion.w;
  s.a = acceleration.head<3>();
  s.alpha = acceleration.tail<3>();
  s.ideal_a = ideal_acceleration.head<3>();
  s.ideal_alpha = ideal_acceleration.tail<3>();
  return s;
}

const PoseError& MotionRecorder::accept(double t, const BodyMotion& body, const BodyAcceleration& acceleration,
                                        const PoseError* bound) {
  t_ = t;
  if (!watched_ && ++accepted_ % kStepsBetweenLooks == 0)
    work_reached("following the motion", t / mechanism_.duration());
  const int index = mechanism_.boresight_body();
  const BodyMotion ideal = ideal_.body(t, index);
  error_ = bound ? *bound : pose_error({body.p, Quat(body.R)}, {ideal.p, Quat(ideal.R)}, mechanism_.pointing());
  indices_.add(t, error_);
  position_error_max_ = std::max(position_error_max_, error_.position);
  if (t >= start_)
    result_.platform_acceleration_max = result_.platform_acceleration_max.cwiseMax(acceleration.head<3>().cwiseAbs());
  result_.end_time = t;
  sampling_ = wants_sample(t);
  framing_ = sampling_ && frame_spacing_ > 0.0 && t >= (frames_ - kSlack) * frame_spacing_;
  if (framing_) {
    frames_ = std::max(frames_ + 1.0, std::floor(t / frame_spacing_ + kSlack) + 1.0);
    result_.frames.push_back({.sample = result_.time.size(), .pose = {}, .ideal = {}});
  }
  if (sampling_) {
    samples_ = std::max(samples_ + 1.0, std::floor(t / spacing_ + kSlack) + 1.0);
    result_.time.push_back(t);
    result_.boresight.samples.push_back(pose_sample(index, body, acceleration));
    if (bound) result_.boresight.samples.back().error = error_;
  }
  return error_;
}

void MotionRecorder::sample_body(int wanted, const BodyMotion& body, const BodyAcceleration& acceleration) {
  const std::size_t asked_for = result_.others.size();
  if (static_cast<std::size_t>(wanted) >= asked_for) {
    const BodyMotion ideal = ideal_.body(t_, bodies_of_frame_[wanted]);
    result_.frames.back().pose.push_back({body.p, Quat(body.R)});
    result_.frames.back().ideal.push_back({ideal.p, Quat(ideal.R)});
    return;
  }
  BodyHistory& history = result_.others[wanted];
  history.samples.push_back(pose_sample(history.body, body, acceleration));
}

void MotionRecorder::sample_clearance(int clearance, const PlayMotion<double>& motion,
                                      const std::array<ContactState<double>, kContactPlaces>& contact) {
  ClearanceSample s;
  s.offset = motion.e;
  s.offset_rate = motion.e_dot;
  s.penetration = -1e300;
  bool radial = false, axial = false;
  for (int k = 0; k < kContactPlaces; ++k) {
    if (contact[k].penetration == -1.0) continue;  // a place this joint does not have
    s.penetration = std::max(s.penetration, contact[k].penetration);
    if (contact[k].penetration <= 0.0) continue;
    s.normal_force += contact[k].normal_force;
    (is_axial(static_cast<ContactPlace>(k)) ? axial : radial) = true;
  }
  s.contact = (radial ? 1 : 0) + (axial ? 2 : 0);
  result_.clearances[clearance].push_back(s);
}

RunResult MotionRecorder::finish() {
  result_.index = indices_.result();
  result_.peaks = indices_.peaks();
  result_.start = start_;
  return std::move(result_);
}

}  // namespace boresight
