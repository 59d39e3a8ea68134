#include "boresight/mechanism/load_time.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "boresight/math/constant_law.hpp"

namespace boresight {
namespace {

constexpr double kFewest = 1024.0, kMost = 1048576.0;  // looks along a motion
constexpr double kMostAtErrors = 16384.0;              // each asks every law

// Of a look: both ends, and between them no two apart by a whole number of anything's periods, which would look like no change at all.
double time_of_look(int look, int looks, double duration) {
  constexpr double kGolden = 0.6180339887498949;
  if (look == 0 || look == looks) return look == 0 ? 0.0 : duration;
  return duration * (look + std::fmod(look * kGolden, 1.0) - 0.5) / looks;
}

// How far a law goes, and how fast at most.
struct Course {
  double least = std::numeric_limits<double>::infinity(), largest = -least, rate = 0.0;
  void add(const TimeValue& value) {
    least = std::min(least, value.value);
    largest = std::max(largest, value.value);
    rate = std::max(rate, std::abs(value.rate));
  }
  // In which it changes by all that it does.
  double time() const {
    return rate > 0.0 && largest > least ? (largest - least) / rate : std::numeric_limits<double>::infinity();
  }
};

int looks_along(double duration, double most) {
  return static_cast<int>(std::clamp(std::ceil(duration / kLookedAt), kFewest, most));
}

}  // namespace

double load_time(const Mechanism& mechanism) {
  constexpr double kNothing = 1e-6;  // a load that moves nothing that anybody sees may change as fast as it likes
  const double duration = mechanism.duration();
  const int looks = looks_along(duration, kMost);
  struct Change {
    double range = 0.0, rate = 0.0;  // as forces [N, N/s]
  };
  std::vector<Change> changes;
  // Beside the weight of all bodies and the largest of the loads.
  double size = mechanism.description().payload ? mechanism.description().payload->mass : 0.0;
  for (const BodyDescription& body : mechanism.description().bodies) size += body.mass;
  size *= mechanism.description().gravity.norm();
  const auto look = [&](const TimeFunctionPtr& load, double lever) {
    if (!load) return;
    Course course;
    const int own = dynamic_cast<const ConstantFunction*>(load.get()) != nullptr ? 0 : looks;
    for (int i = 0; i <= own; ++i) course.add(load->at(time_of_look(i, looks, duration)));
    changes.push_back({(course.largest - course.least) / lever, course.rate / lever});
    size = std::max({size, std::abs(course.least) / lever, std::abs(course.largest) / lever});
  };
  for (const LoadDescription& load : mechanism.description().loads) {
    const bool torque = load.joint && mechanism.description().joints[*load.joint].type == JointType::revolute;
    look(load.along_joint, torque ? mechanism.characteristic_length() : 1.0);
    for (const TimeFunctionPtr& f : load.force) look(f, 1.0);
  }
  double shortest = std::numeric_limits<double>::infinity();
  for (const Change& change : changes)
    if (change.rate > 0.0 && change.range > kNothing * size) shortest = std::min(shortest, change.range / change.rate);
  return shortest;
}

std::vector<double> error_times(const Mechanism& mechanism, const IdealMotion& commanded,
                                const std::vector<bool>& wanted) {
  std::vector<double> times(wanted.size(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> laws;
  for (std::size_t e = 0; e < wanted.size(); ++e)
    if (const ErrorDescription& error = mechanism.description().errors[e];
        wanted[e] && error.law && dynamic_cast<const ConstantLaw*>(error.law.get()) == nullptr)
      laws.push_back(e);
  if (laws.empty()) return times;
  const double duration = mechanism.duration();
  const int looks = looks_along(duration, kMostAtErrors);
  std::vector<TimeValue> drives(static_cast<std::size_t>(mechanism.joints()));
  std::vector<Course> courses(laws.size());
  for (int i = 0; i <= looks; ++i) {
    const double t = time_of_look(i, looks, duration);
    commanded.drive_laws(t, drives);
    for (std::size_t k = 0; k < laws.size(); ++k) {
      const ErrorDescription& error = mechanism.description().errors[laws[k]];
      courses[k].add(error.law->at(drives[static_cast<std::size_t>(error.joint)], t));
    }
  }
  for (std::size_t k = 0; k < laws.size(); ++k) times[laws[k]] = courses[k].time();
  return times;
}

double least_error_time(const Mechanism& mechanism, double time) {
  return std::max(time, mechanism.duration() / looks_along(mechanism.duration(), kMostAtErrors));
}

double error_time(const Mechanism& mechanism, const IdealMotion& commanded, const std::vector<bool>& wanted) {
  const std::vector<double> times = error_times(mechanism, commanded, wanted);
  double shortest = std::numeric_limits<double>::infinity();
  for (const double time : times) shortest = std::min(shortest, time);
  return least_error_time(mechanism, shortest);  // a jump takes no time
}

}  // namespace boresight
