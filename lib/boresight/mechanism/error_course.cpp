#include "boresight/mechanism/error_course.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "boresight/mechanism/course_fault.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

class DriveOfMotion final : public TimeFunction {
 public:
  DriveOfMotion(const IdealMotion& motion, int joint) : motion_(motion), joint_(joint) {}
  TimeValue at(double t) const override { return motion_.drive_law(t, joint_); }

 private:
  const IdealMotion& motion_;
  int joint_;
};

// A course that is read off poses has their rounding, in its rate too, where two pieces of a spline meet. A law makes of it what it
// makes of the drive's way: no jump nor corner is one that a drive at rest would show by its rounding.
LeastSizes rounding_of(const CoordinateFunction& law, const TimeFunction& drive, double duration, double length) {
  constexpr int kLooks = 400;
  constexpr double kWay = 0.1;  // of the mechanism's size, or of a radian: a drive is taken to go at least that far
  constexpr double kOfAValue = 1e-6;  // a value's rounding is so much smaller than its rate's, times the duration
  double way = kWay * length, steepest = 0.0;
  for (int k = 0; k <= kLooks; ++k) {
    const double t = duration * k / kLooks, q = drive.at(t).value;
    way = std::max(way, std::abs(q));
    const double slope = law.at({q, 1.0, 0.0}, t).rate - law.at({q, 0.0, 0.0}, t).rate;
    if (std::isfinite(slope)) steepest = std::max(steepest, std::abs(slope));
  }
  return {kOfAValue * steepest * way, steepest * way / duration};
}

}  // namespace

void require_laws_along(const Mechanism& mechanism, const IdealMotion& motion) {
  for (const ErrorDescription& error : mechanism.description().errors) {
    if (error.kind != ErrorDescription::Kind::drive || !error.law) continue;
    const bool slides = mechanism.description().joints[error.joint].type == JointType::prismatic;
    const auto drive = std::make_shared<const DriveOfMotion>(motion, error.joint);
    const ErrorAlongDrive along(error.law, drive);
    std::optional<CourseFault> fault = not_finite(along, motion.duration());
    if (!fault)
      fault = not_continuous(
          along, motion.duration(),
          rounding_of(*error.law, *drive, motion.duration(), slides ? mechanism.characteristic_length() : 1.0));
    if (fault)
      throw InputError(error.law_origin.line > 0 || !error.law_origin.file.empty() ? error.law_origin : error.origin,
                       "error." + error.name + ".law",
                       (error.law_text.empty() ? "a law" : '"' + error.law_text + '"') + fault->found, fault->expected);
  }
}

}  // namespace boresight
