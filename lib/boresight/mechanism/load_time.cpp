#include "boresight/mechanism/load_time.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "boresight/math/constant_law.hpp"

namespace boresight {
namespace {

constexpr double kFewest = 1024.0, kMost = 65536.0;  // looks along a motion
constexpr double kMostAtErrors = 16384.0;            // each asks every law

}  // namespace

double load_time(const Mechanism& mechanism) {
  constexpr double kNothing = 1e-6;  // a load that moves nothing that anybody sees may change as fast as it likes
  const double duration = mechanism.duration();
  const int looks = static_cast<int>(std::clamp(std::ceil(duration / kLookedAt), kFewest, kMost));
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
    double least = std::numeric_limits<double>::infinity(), largest = -least, rate = 0.0;
    const int own = dynamic_cast<const ConstantFunction*>(load.get()) != nullptr ? 0 : looks;
    for (int i = 0; i <= own; ++i) {
      const TimeValue f = load->at(duration * i / looks);
      least = std::min(least, f.value);
      largest = std::max(largest, f.value);
      rate = std::max(rate, std::abs(f.rate));
    }
    changes.push_back({(largest - least) / lever, rate / lever});
    size = std::max({size, std::abs(least) / lever, std::abs(largest) / lever});
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

double error_time(const Mechanism& mechanism, const IdealMotion& commanded, const std::vector<bool>& wanted) {
  struct Law {
    const ErrorDescription* error;
    double least = std::numeric_limits<double>::infinity(), largest = -least, rate = 0.0;
  };
  std::vector<Law> laws;
  for (std::size_t e = 0; e < wanted.size(); ++e)
    if (const ErrorDescription& error = mechanism.description().errors[e];
        wanted[e] && error.law && dynamic_cast<const ConstantLaw*>(error.law.get()) == nullptr)
      laws.push_back({&error});
  double shortest = std::numeric_limits<double>::infinity();
  if (laws.empty()) return shortest;
  const double duration = mechanism.duration();
  const int looks = static_cast<int>(std::clamp(std::ceil(duration / kLookedAt), kFewest, kMostAtErrors));
  std::vector<TimeValue> drives(static_cast<std::size_t>(mechanism.joints()));
  for (int i = 0; i <= looks; ++i) {
    const double t = duration * i / looks;
    commanded.drive_laws(t, drives);
    for (Law& law : laws) {
      const TimeValue errs = law.error->law->at(drives[static_cast<std::size_t>(law.error->joint)], t);
      law.least = std::min(law.least, errs.value);
      law.largest = std::max(law.largest, errs.value);
      law.rate = std::max(law.rate, std::abs(errs.rate));
    }
  }
  for (const Law& law : laws)
    if (law.rate > 0.0 && law.largest > law.least) shortest = std::min(shortest, (law.largest - law.least) / law.rate);
  return std::max(shortest, duration / looks);  // a jump takes no time
}

}  // namespace boresight
