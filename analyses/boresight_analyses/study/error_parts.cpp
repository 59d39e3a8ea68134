#include "boresight_analyses/study/error_parts.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

// The four indices of a small displacement and turn.
PoseError linear_pose_error(const Vec6& x, const Pose& ideal, const Pointing& pointing) {
  PoseError e;
  e.displacement = x.head<3>();
  e.rotation = x.tail<3>();
  e.position = e.displacement.norm();
  e.orientation = e.rotation.norm();
  e.boresight = e.rotation.cross(ideal.q * pointing.boresight_B).norm();
  if (pointing.line_of_sight) e.line_of_sight = (pointing.line_of_sight->gain(ideal) * x).norm();
  return e;
}

Vec6 stacked(const PoseError& error) {
  Vec6 x;
  x << error.displacement, error.rotation;
  return x;
}

}  // namespace

std::string taken_up_by_play(const MechanismDescription& mechanism, std::size_t error) {
  const ErrorDescription& e = mechanism.errors[error];
  const std::string name = "error." + e.name, unit = said_unit_of(e, mechanism.joints);
  return name +
         " is taken up by play, so that what it does hangs on where all journals rest; a run with it and one with "
         "--set " +
         name + "=0" +
         (unit == "rad" ? "mrad"
          : unit == "1" ? "ppm"
                        : unit) +
         " tell";
}

ErrorColumns::ErrorColumns(const Mechanism& mechanism, const IdealMotion& commanded)
    : mechanism_(mechanism),
      influence_(StandingErrors::of_all(mechanism, commanded)),
      body_(mechanism.boresight_body()) {}

std::string ErrorColumns::refusal(std::size_t error) const {
  std::vector<double> alone(static_cast<std::size_t>(influence_->count()), 0.0);
  alone[error] = 1.0;
  try {
    influence_->require(alone);
  } catch (const ComputationError& strained) {
    return strained.what();
  }
  return influence_->uses_play(error) ? taken_up_by_play(mechanism_.description(), error) : "";
}

MatX ErrorColumns::at(double t) const {
  const TimeTable& gain = influence_->gain(body_);
  std::vector<double> values(static_cast<std::size_t>(gain.width()));
  gain.at(t, values.data());
  return Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>>(values.data(), 6,
                                                                                     influence_->count());
}

std::vector<double> ErrorColumns::times(double start, double end) const {
  const double spacing = influence_->spacing() / influence_->instants_a_cell();
  const auto steps = static_cast<int>(std::max(1.0, std::ceil((end - start) / spacing - 1e-9)));
  std::vector<double> times;
  for (int k = 0; k <= steps; ++k) times.push_back(start + (end - start) * k / steps);
  return times;
}

Vec3 linear_error_vector(PointingQuantity quantity, const Vec6& x, const Pose& ideal, const Pointing& pointing,
                         double length) {
  // Central differences of a function that is smooth in the pose; their error is the square of the step.
  constexpr double kStep = 1e-5;
  const double size = x.head<3>().norm() / length + x.tail<3>().norm();
  if (!(size > 0.0)) return Vec3::Zero();
  const double factor = kStep / size;
  const auto displaced = [&](double by) {
    const Vec3 turn = by * x.tail<3>();
    const double angle = turn.norm();
    Pose pose = ideal;
    pose.p += by * x.head<3>();
    if (angle > 0.0) pose.q = Quat(Eigen::AngleAxisd(angle, turn / angle)) * ideal.q;
    return error_vector(quantity, pose, ideal, pointing);
  };
  return (displaced(factor) - displaced(-factor)) / (2.0 * factor);
}

ErrorParts parts_of_errors(const Mechanism& mechanism, const Parameters& parameters, const RunResult& run) {
  ErrorParts found;
  const MechanismDescription& description = mechanism.description();
  if (std::all_of(parameters.error.begin(), parameters.error.end(), [](double value) { return value == 0.0; }))
    return found;
  const IdealMotion commanded = ideal_motion(mechanism, parameters);
  const ErrorColumns columns(mechanism, commanded);
  const Pointing& pointing = mechanism.pointing();
  const auto ideal_at = [&](double t) {
    const BodyMotion body = commanded.body(t, mechanism.boresight_body());
    return Pose{body.p, Quat(body.R)};
  };
  const std::vector<PoseSample>& samples = run.boresight.samples;
  const bool sighted = pointing.line_of_sight.has_value();

  found.rest.name = "rest";
  std::vector<std::size_t> places;  // of the parts, in the file
  for (std::size_t e = 0; e < description.errors.size(); ++e) {
    if (parameters.error[e] == 0.0) continue;
    if (std::string why = columns.refusal(e); !why.empty()) {
      found.without_part.push_back(std::move(why));
      continue;
    }
    places.push_back(e);
    found.parts.push_back({.name = "error." + description.errors[e].name,
                           .unit = said_unit_of(description.errors[e], description.joints),
                           .value = parameters.error[e],
                           .index = {},
                           .poses = {}});
  }
  const auto part_at = [&](const MatX& G, std::size_t i) {
    return Vec6(found.parts[i].value * G.col(static_cast<Eigen::Index>(places[i])));
  };
  std::vector<IndicesOverTime> indices(places.size(), IndicesOverTime(sighted));
  for (const double t : columns.times(run.start, std::max(run.start, run.end_time))) {
    const MatX G = columns.at(t);
    const Pose ideal = ideal_at(t);
    for (std::size_t i = 0; i < places.size(); ++i)
      indices[i].add(t, linear_pose_error(part_at(G, i), ideal, pointing));
  }
  for (std::size_t i = 0; i < places.size(); ++i) found.parts[i].index = indices[i].result();
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const MatX G = columns.at(run.time[k]);
    found.rest.poses.push_back(stacked(samples[k].error));
    for (std::size_t i = 0; i < places.size(); ++i) {
      found.parts[i].poses.push_back(part_at(G, i));
      found.rest.poses.back() -= found.parts[i].poses.back();
    }
  }

  IndicesOverTime rest(sighted, run.start);
  for (std::size_t k = 0; k < samples.size(); ++k)
    rest.add(run.time[k], linear_pose_error(found.rest.poses[k], samples[k].ideal, pointing));
  if (!samples.empty()) found.rest.index = rest.result();
  std::vector<ErrorPart*> all = {&found.rest};
  for (ErrorPart& part : found.parts) all.push_back(&part);
  for (ErrorPart* part : all) {
    double position = 0.0, positions = 0.0, boresight = 0.0, boresights = 0.0;
    for (std::size_t k = 0; k < samples.size(); ++k) {
      if (run.time[k] < run.start) continue;
      const PoseError& whole = samples[k].error;
      const Vec3 axis = samples[k].ideal.q * pointing.boresight_B, turned = whole.rotation.cross(axis);
      position += part->poses[k].head<3>().dot(whole.displacement);
      positions += whole.displacement.squaredNorm();
      boresight += Vec3(part->poses[k].tail<3>()).cross(axis).dot(turned);
      boresights += turned.squaredNorm();
    }
    part->position_share = positions > 0.0 ? position / positions : 0.0;
    part->boresight_share = boresights > 0.0 ? boresight / boresights : 0.0;
  }
  double largest_position = 0.0, largest_boresight = 0.0;
  for (const ErrorPart& part : found.parts) {
    largest_position = std::max(largest_position, part.index.position_error.rms);
    largest_boresight = std::max(largest_boresight, part.index.boresight_error.rms);
  }
  const auto weight = [&](const ErrorPart& part) {
    const auto of = [](double value, double largest) { return largest > 0.0 ? value / largest : 0.0; };
    return std::max(of(part.index.position_error.rms, largest_position),
                    of(part.index.boresight_error.rms, largest_boresight));
  };
  std::stable_sort(found.parts.begin(), found.parts.end(),
                   [&](const ErrorPart& a, const ErrorPart& b) { return weight(a) > weight(b); });
  return found;
}

}  // namespace boresight
