#include "boresight/scene/scene_rung.hpp"

#include <algorithm>
#include <chrono>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/cpu_clock.hpp"
#include "boresight/rungs/option_check.hpp"
#include "boresight/scene/held_play.hpp"
#include "boresight/stepping/motion_scales.hpp"

namespace boresight {
namespace {

// Rates of change of a table's functions.
void slopes_at(const TimeTable& table, double t, double* out) {
  const double x = t / table.spacing();
  const int k = std::clamp(static_cast<int>(x), 0, table.cells() - 1), width = table.width();
  const double s = x - k, *c = table.cell(k) + width;
  for (int j = 0; j < width; ++j)
    out[j] = (c[j] + s * (2.0 * c[width + j] + s * 3.0 * c[2 * width + j])) / table.spacing();
}

}  // namespace

bool same_scene(const Parameters& a, const Parameters& b) {
  if (a.gravity != b.gravity || a.payload_mass != b.payload_mass || a.body_mass != b.body_mass) return false;
  for (std::size_t s = 0; s < a.spring.size(); ++s)
    if (a.spring[s].stiffness != b.spring[s].stiffness || a.spring[s].damping != b.spring[s].damping ||
        a.spring[s].free_length != b.spring[s].free_length)
      return false;
  return true;
}

PreparedScene::PreparedScene(const Mechanism& mechanism, IdealMotion ideal_motion, const Parameters& parameters,
                             double accuracy)
    : ideal_(std::move(ideal_motion)),
      scene_(mechanism, ideal_, parameters, accuracy),
      own_time_(boresight::own_time(ideal_, mechanism.bodies(), mechanism.characteristic_length())) {
  if (scene_.coordinates().has_dependent()) held_ = held_plays(mechanism, ideal_);
}

std::shared_ptr<const SceneTables> PreparedScene::tables(const Parameters& parameters) const {
  const std::lock_guard lock(mutex_);
  if (!tables_ || !same_scene(tabled_, parameters)) {
    tables_ = std::make_shared<const SceneTables>(scene_.tables(parameters));
    tabled_ = parameters;
  }
  return tables_;
}

const TimeTable& PreparedScene::pose_gain(int body) const {
  const std::lock_guard lock(mutex_);
  if (scene_.layout().n == 0) return pose_gain_[body];  // an empty table: nothing deviates
  const auto found = pose_gain_.find(body);
  return found != pose_gain_.end() ? found->second : pose_gain_.emplace(body, scene_.pose_gain(body)).first->second;
}

const TimeTable& PreparedScene::pose_gain_rate(int body) const {
  const std::lock_guard lock(mutex_);
  const auto found = pose_gain_rate_.find(body);
  return found != pose_gain_rate_.end() ? found->second
                                        : pose_gain_rate_.emplace(body, scene_.pose_gain_rate(body)).first->second;
}

DisplacedBodies::PoseGain DisplacedBodies::gain(const TimeTable& table) const {
  PoseGain E(6, z_.size());
  if (z_.size() > 0) table.at(t_, E.data());
  return E;
}

BodyMotion DisplacedBodies::at_rest(int body, BodyAcceleration& acceleration) const {
  BodyMotion motion = prepared_.ideal().body(t_, body, &acceleration);
  displace(motion, gain(prepared_.pose_gain(body)) * z_);
  return motion;
}

BodyMotion DisplacedBodies::moving(int body, const Eigen::Ref<const VecX>& z_dot, const Eigen::Ref<const VecX>& z_ddot,
                                   BodyAcceleration& acceleration) const {
  const TimeTable& rates = prepared_.pose_gain_rate(body);
  const PoseGain E = gain(prepared_.pose_gain(body)), E_dot = gain(rates);
  PoseGain E_ddot(6, z_.size());
  slopes_at(rates, t_, E_ddot.data());
  BodyMotion motion = prepared_.ideal().body(t_, body, &acceleration);
  const Vec3 w = motion.w, alpha = acceleration.tail<3>();
  const Vec6 x = E * z_, rate = E * z_dot + E_dot * z_;
  displace(motion, x);
  motion.v += rate.head<3>();
  motion.w += rate.tail<3>() + x.tail<3>().cross(w);
  acceleration += E * z_ddot + 2.0 * E_dot * z_dot + E_ddot * z_;
  acceleration.tail<3>() += rate.tail<3>().cross(w) + x.tail<3>().cross(alpha);
  return motion;
}

std::shared_ptr<const PreparedScene> SceneRung::prepared_for(const Parameters& parameters) const {
  if (mechanism_->clearances() == 0)
    throw ComputationError("no joint has clearance, so nothing deviates from the ideal motion; multibody follows that");
  const std::lock_guard lock(mutex_);
  if (!prepared_ || (!is_kinematic(*mechanism_) && !same_scene(prepared_parameters_, parameters))) {
    prepared_ = std::make_shared<const PreparedScene>(*mechanism_, ideal_motion(*mechanism_, parameters), parameters);
    prepared_parameters_ = parameters;
  }
  return prepared_;
}

RunResult SceneRung::run(const Parameters& parameters, const RunOptions& options) const {
  check_options(options, name(), *mechanism_, parameters);
  const auto wall = std::chrono::steady_clock::now();
  const double cpu = thread_cpu_seconds();
  const std::shared_ptr<const PreparedScene> prepared = prepared_for(parameters);
  RunResult result = prepared->scene().layout().n == 0
                         ? motion_without_play(*mechanism_, prepared->ideal(), parameters, options)
                         : follow(*prepared, parameters, options);
  result.warnings.insert(result.warnings.begin(), prepared->held().begin(), prepared->held().end());
  result.rung = name();
  result.cost.cpu_seconds = thread_cpu_seconds() - cpu;
  result.cost.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  return result;
}

}  // namespace boresight
