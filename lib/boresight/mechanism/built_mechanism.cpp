#include "boresight/mechanism/built_mechanism.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>

#include "boresight/mechanism/drawn_joint.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/offset_choice.hpp"

namespace boresight {
namespace {

using Kind = ErrorDescription::Kind;

// Where a body that grows stays: its centre of mass; on the ground the middle of the joints there, which does not hang on where the
// drawing lies.
Vec3 centre_of_growth(const MechanismDescription& m, int body) {
  if (body != kGround) return m.bodies[body].center_of_mass;
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (int j = 0; j < static_cast<int>(m.joints.size()); ++j)
    if ((m.joints[j].first == kGround || m.joints[j].second == kGround) && !is_floating_bearing(m, j)) {
      sum += drawn_point(m, j);
      ++count;
    }
  return count > 0 ? Vec3(sum / count) : sum;
}

// Of one frame, all errors together; world axes at home.
struct Displacement {
  Vec3 translation = Vec3::Zero(), rotation = Vec3::Zero();
  // The part of the rotation that turns about a point beside the frame, which stands this far off it.
  Vec3 beside = Vec3::Zero(), arm = Vec3::Zero();
};

void displace_frame(const MechanismDescription& m, const Displacement& by, JointFrame& frame, Vec3* second_axis) {
  const Mat3 axes = frame.body == kGround ? Mat3(Mat3::Identity()) : m.bodies[frame.body].axes;
  const auto turn_of = [&](const Vec3& rotation) {
    const double angle = rotation.norm();
    return angle > 0.0 ? Eigen::AngleAxisd(angle, axes.transpose() * rotation / angle).toRotationMatrix()
                       : Mat3(Mat3::Identity());
  };
  frame.p += axes.transpose() * by.translation;
  const Vec3 arm = axes.transpose() * by.arm;
  frame.p += turn_of(by.beside) * arm - arm;
  if (!(by.rotation.norm() > 0.0)) return;
  const Mat3 turn = turn_of(by.rotation);
  frame.R = turn * frame.R;
  if (second_axis) *second_axis = turn * *second_axis;
}

// What all drives are told. They are asked one after the other at one instant, and several times there while joints are closed: each thread
// keeps the last answer.
class CommandedLaws {
 public:
  CommandedLaws(int joints, std::shared_ptr<const IdealMotion> commanded)
      : joints_(joints), commanded_(std::move(commanded)), number_(++made_) {}

  const std::vector<TimeValue>& at(double t) const {
    struct Last {
      std::uint64_t number = 0;  // of none
      double t = 0.0;
      std::vector<TimeValue> laws;
    };
    thread_local Last last;
    if (last.number == number_ && last.t == t) return last.laws;
    last.number = 0;  // in case there is no answer
    last.laws.resize(static_cast<std::size_t>(joints_));
    commanded_->drive_laws(t, last.laws);
    last.number = number_;
    last.t = t;
    return last.laws;
  }

 private:
  static inline std::atomic<std::uint64_t> made_{0};
  int joints_;
  std::shared_ptr<const IdealMotion> commanded_;
  std::uint64_t number_;  // unlike an address, no other object's ever
};

// A drive that is told where the drawn mechanism's stands, and errs.
class ErringDrive final : public TimeFunction {
 public:
  ErringDrive(const Mechanism& drawn, const Parameters& parameters, int joint,
              std::shared_ptr<const CommandedLaws> commanded)
      : joint_(joint), commanded_(std::move(commanded)) {
    const std::vector<ErrorDescription>& errors = drawn.description().errors;
    for (std::size_t e = 0; e < errors.size(); ++e)
      if (errors[e].kind == Kind::drive && errors[e].joint == joint && parameters.error[e] != 0.0)
        errors_.emplace_back(parameters.error[e], errors[e].law);
  }

  TimeValue at(double t) const override {
    const TimeValue told = commanded_->at(t)[static_cast<std::size_t>(joint_)];
    TimeValue does = told;
    for (const auto& [value, law] : errors_) {
      const TimeValue error = law->at(told, t);
      does.value += value * error.value;
      does.rate += value * error.rate;
      does.acceleration += value * error.acceleration;
    }
    return does;
  }

 private:
  int joint_;
  std::shared_ptr<const CommandedLaws> commanded_;
  std::vector<std::pair<double, CoordinateFunctionPtr>> errors_;
};

}  // namespace

std::vector<FrameError> frame_errors(const MechanismDescription& m, const ErrorDescription& error) {
  std::vector<FrameError> frames;
  switch (error.kind) {
    case Kind::translation:
    case Kind::rotation: {
      const bool second = m.joints[error.joint].second == error.body;
      for (int joint : {error.joint, floating_bearing(m, error.joint)}) {
        if (joint < 0) continue;
        FrameError frame{.joint = joint, .second = second};
        if (error.kind == Kind::translation) {
          frame.translation = error.direction;
        } else {
          frame.rotation = error.direction;
          if (floating_bearing(m, error.joint) >= 0) frame.arm = m.joints[joint].point - drawn_point(m, error.joint);
        }
        frames.push_back(frame);
      }
      break;
    }
    case Kind::drive:
      break;
    case Kind::expansion: {
      const Vec3 centre = centre_of_growth(m, error.body);
      for (std::size_t j = 0; j < m.joints.size(); ++j)
        if (const JointDescription& joint = m.joints[j]; joint.first == error.body || joint.second == error.body)
          frames.push_back({.joint = static_cast<int>(j),
                            .second = joint.second == error.body,
                            .translation = error.coefficient * (joint.point - centre)});
      break;
    }
  }
  return frames;
}

bool has_errors(const Parameters& parameters) {
  return std::any_of(parameters.error.begin(), parameters.error.end(), [](double value) { return value != 0.0; });
}

std::shared_ptr<const Mechanism> built_mechanism(const Mechanism& drawn, const Parameters& parameters,
                                                 std::shared_ptr<const IdealMotion> commanded) {
  const MechanismDescription& m = drawn.description();
  std::vector<std::array<Displacement, 2>> displaced(m.joints.size());  // in the first body, in the second
  for (std::size_t e = 0; e < m.errors.size(); ++e)
    for (const FrameError& frame : frame_errors(m, m.errors[e])) {
      Displacement& d = displaced[frame.joint][frame.second ? 1 : 0];
      d.translation += parameters.error[e] * frame.translation;
      d.rotation += parameters.error[e] * frame.rotation;
      if (frame.arm.isZero(0.0)) continue;
      d.beside += parameters.error[e] * frame.rotation;
      d.arm = frame.arm;
    }
  std::vector<JointGeometry> geometry;
  std::map<int, TimeFunctionPtr> drives;
  const auto told = std::make_shared<const CommandedLaws>(drawn.joints(), commanded);
  for (int j = 0; j < drawn.joints(); ++j) {
    JointGeometry g = drawn.geometry(j);
    displace_frame(m, displaced[j][0], g.first, nullptr);
    displace_frame(m, displaced[j][1], g.second, &g.second_axis);
    geometry.push_back(g);
    if (m.joints[j].driven) drives[j] = std::make_shared<ErringDrive>(drawn, parameters, j, told);
  }
  std::shared_ptr<const OffsetChoice> choice;
  if (drawn.clearances() > 0) {
    try {
      auto chosen = std::make_shared<OffsetChoice>(choose_offsets(drawn, *commanded));
      if (chosen->has_dependent) choice = std::move(chosen);
    } catch (const ComputationError&) {
      // Offsets do not describe all that the mechanism can do. Its joints are closed as drawn, and multibody follows it.
    }
  }
  return std::make_shared<const Mechanism>(drawn, std::move(geometry), std::move(drives), std::move(choice));
}

}  // namespace boresight
