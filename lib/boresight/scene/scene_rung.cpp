#include "boresight/scene/scene_rung.hpp"

#include <algorithm>
#include <chrono>
#include <numeric>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/load_time.hpp"
#include "boresight/rungs/cpu_clock.hpp"
#include "boresight/rungs/option_check.hpp"
#include "boresight/scene/held_play.hpp"
#include "boresight/scene/standing_model_error.hpp"
#include "boresight/scene/tipping.hpp"
#include "boresight/stepping/motion_scales.hpp"

namespace boresight {
namespace {

constexpr char kBasisOfErrors[] =
    "standing errors made exactly at some instants, by closing the built mechanism's joints";

}  // namespace

bool same_centers(const Parameters& a, const Parameters& b) {
  return a.body_center == b.body_center && a.payload_center == b.payload_center;
}

bool same_scene(const Parameters& a, const Parameters& b) {
  return same_centers(a, b) && a.gravity == b.gravity && a.payload_mass == b.payload_mass &&
         a.body_mass == b.body_mass && a.spring == b.spring;
}

PreparedScene::PreparedScene(const Mechanism& mechanism, IdealMotion ideal_motion, const Parameters& parameters,
                             double accuracy)
    : mechanism_(mechanism),
      ideal_(std::move(ideal_motion)),
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

std::shared_ptr<const SceneTables> PreparedScene::tables(const Parameters& parameters,
                                                         const StandingDisplacement& standing) const {
  std::shared_ptr<const SceneTables> shared = tables(parameters);
  if (!standing || scene_.layout().n == 0) return shared;
  auto own = std::make_shared<SceneTables>(*shared);
  own->load_change = changed_accelerations(parameters, standing, *own).table(own->layout.n);
  if (own->load_change.width() > 0) own->load_change.add(0.0, &own->start.row[own->layout.Ar]);
  if (!standing.shifts()) return own;
  // The errors' own grid, where it is the finer one: a drive may err far faster than it moves.
  const int cells = std::max(own->dynamics.cells(), standing.influence().cells());
  const double spacing = mechanism_.duration() / cells;
  own->shifts.resize(own->layout.joints.size());
  for (std::size_t c = 0; c < own->layout.joints.size(); ++c) {
    const SceneLayout::Joint& joint = own->layout.joints[c];
    if (!joint.has_dependent) continue;
    const int first = scene_.offsets().joint(static_cast<int>(c)).first;
    std::vector<double> values;
    for (int k = 0; k <= cells; ++k) {
      const StandingDisplacement::Shift shift = standing.shift(k * spacing);
      for (const VecX* part : {&shift.value, &shift.rate})
        for (int i = 0; i < joint.offsets; ++i) values.push_back((*part)[first + i]);
    }
    const int width = 2 * joint.offsets;
    own->shifts[c] = TimeTable(spacing, width, values);
    std::copy_n(values.begin(), width, own->start.row.begin() + joint.shift);
  }
  return own;
}

const TimeTable& PreparedScene::pose_gain(int body) const {
  const std::lock_guard lock(mutex_);
  if (scene_.layout().n == 0) return pose_gain_[body];  // an empty table: nothing deviates
  const auto found = pose_gain_.find(body);
  return found != pose_gain_.end() ? found->second : pose_gain_.emplace(body, scene_.pose_gain(body)).first->second;
}

const TimeTable& PreparedScene::pose_gain_rate(int body) const {
  const std::lock_guard lock(mutex_);
  if (scene_.layout().n == 0) return pose_gain_rate_[body];
  const auto found = pose_gain_rate_.find(body);
  return found != pose_gain_rate_.end() ? found->second
                                        : pose_gain_rate_.emplace(body, scene_.pose_gain_rate(body)).first->second;
}

StandingDisplacement PreparedScene::standing(const Parameters& parameters) const {
  if (!has_errors(parameters)) return {};
  // Of all errors that there are, so that a sample's table does not hang on which came before it.
  const std::lock_guard lock(mutex_);
  if (!errors_) errors_ = StandingErrors::of_all(mechanism_, ideal_);
  errors_->require(parameters.error);
  return {errors_, parameters.error};
}

const std::vector<double>& PreparedScene::error_times() const {
  std::call_once(error_times_once_, [this] {
    const std::vector<bool> all(mechanism_.description().errors.size(), true);
    error_times_ = boresight::error_times(mechanism_, ideal_, all);
  });
  return error_times_;
}

StandingLoads::Change PreparedScene::changed_loads(const Parameters& parameters,
                                                   const StandingDisplacement& standing) const {
  if (!standing || scene_.layout().n == 0) return {};
  std::shared_ptr<const StandingLoads> loads;
  {
    const std::lock_guard lock(mutex_);
    if (!loads_) loads_ = std::make_shared<const StandingLoads>(mechanism_, ideal_);
    loads = loads_;
  }
  return loads->change(parameters, standing.influence());
}

StandingLoads::Change PreparedScene::changed_accelerations(const Parameters& parameters,
                                                           const StandingDisplacement& standing,
                                                           const SceneTables& accelerations) const {
  StandingLoads::Change change = changed_loads(parameters, standing);
  const SceneLayout& at = accelerations.layout;
  std::vector<double> row(static_cast<std::size_t>(accelerations.dynamics.width()));
  MatX A;
  for (std::size_t k = 0; k * at.n < change.values.size(); ++k) {
    accelerations.dynamics.at(static_cast<double>(k) * change.spacing, row.data());
    at.inverse_mass(row.data(), A);
    Eigen::Map<VecX> load(&change.values[k * at.n], at.n);
    load = (A * load).eval();
  }
  return change;
}

DisplacedBodies::PoseGain DisplacedBodies::gain(const TimeTable& table) const {
  PoseGain E(6, z_.size());
  if (z_.size() > 0) table.at(t_, E.data());
  return E;
}

Vec6 DisplacedBodies::displacement(int body) const {
  return gain(prepared_.pose_gain(body)) * z_ + standing_.at(t_, body);
}

BodyMotion DisplacedBodies::at_rest(int body, BodyAcceleration& acceleration) const {
  BodyMotion motion = prepared_.ideal().body(t_, body, &acceleration);
  displace(motion, displacement(body));
  return motion;
}

BodyMotion DisplacedBodies::moving(int body, const Eigen::Ref<const VecX>& z_dot, const Eigen::Ref<const VecX>& z_ddot,
                                   BodyAcceleration& acceleration) const {
  const TimeTable& rates = prepared_.pose_gain_rate(body);
  const PoseGain E = gain(prepared_.pose_gain(body)), E_dot = gain(rates);
  PoseGain E_ddot(6, z_.size());
  if (z_.size() > 0) rates.slopes(t_, E_ddot.data());
  const StandingDisplacement::Motion standing = standing_.motion(t_, body);
  BodyMotion motion = prepared_.ideal().body(t_, body, &acceleration);
  const Vec3 w = motion.w, alpha = acceleration.tail<3>();
  const Vec6 x = E * z_ + standing.value, rate = E * z_dot + E_dot * z_ + standing.rate;
  displace(motion, x);
  motion.v += rate.head<3>();
  motion.w += rate.tail<3>() + x.tail<3>().cross(w);
  acceleration += E * z_ddot + 2.0 * E_dot * z_dot + E_ddot * z_ + standing.acceleration;
  acceleration.tail<3>() += rate.tail<3>().cross(w) + x.tail<3>().cross(alpha);
  return motion;
}

bool serves(const Mechanism& mechanism, const PreparedScene& kept, const Parameters& its_own,
            const Parameters& parameters) {
  if (!same_centers(its_own, parameters)) return false;
  if (same_scene(its_own, parameters)) return true;
  if (!is_kinematic(mechanism) || kept.scene().tips()) return false;
  return mechanism.clearances() == 0 || !ClearanceScene::would_tip(mechanism, kept.ideal(), parameters);
}

std::shared_ptr<const PreparedScene> SceneRung::prepared_for(const Parameters& parameters) const {
  if (mechanism_->clearances() == 0 && mechanism_->description().errors.empty())
    throw ComputationError(
        "no joint has clearance and no [[error]] is declared, so nothing deviates from the ideal motion; multibody "
        "follows that");
  std::unique_lock lock(mutex_);
  if (prepared_) {  // whether it holds for these is asked with nobody waiting
    const std::shared_ptr<const PreparedScene> kept = prepared_;
    const Parameters its_own = prepared_parameters_;
    lock.unlock();
    if (serves(*mechanism_, *kept, its_own, parameters)) return kept;
    lock.lock();
    if (prepared_ != kept && serves(*mechanism_, *prepared_, prepared_parameters_, parameters)) return prepared_;
  }
  // What drives alone decide is the same for all parameters.
  const bool kept = prepared_ && is_kinematic(*mechanism_);
  prepared_ = std::make_shared<const PreparedScene>(
      *mechanism_, kept ? prepared_->ideal() : ideal_motion(*mechanism_, parameters), parameters);
  prepared_parameters_ = parameters;
  return prepared_;
}

RunResult SceneRung::without_play(const PreparedScene& prepared, const StandingDisplacement& standing,
                                  const Parameters& parameters, const RunOptions& options) const {
  if (!standing) return motion_without_play(*mechanism_, prepared.ideal(), prepared.ideal(), parameters, options);
  const VecX none;
  // A body's table is contracted when it is first asked for: only those that somebody looks at.
  std::vector<int> seen = options.pose_bodies;
  seen.push_back(mechanism_->boresight_body());
  if (options.sample_spacing > 0.0 && (options.frame_spacing > 0.0 || mechanism_->clearances() > 0)) {
    seen.resize(static_cast<std::size_t>(mechanism_->bodies()));
    std::iota(seen.begin(), seen.end(), 0);
  }
  return motion_without_play(
      *mechanism_,
      [&](double t, IdealState& state) {
        prepared.ideal().state(t, state);
        const DisplacedBodies displaced(prepared, standing, t, none);
        for (const int b : seen) state.bodies[b] = displaced.moving(b, none, none, state.acceleration[b]);
      },
      prepared.ideal(), parameters, options, standing.influence().spacing() / standing.influence().instants_a_cell());
}

RunResult SceneRung::run(const Parameters& parameters, const RunOptions& options) const {
  check_options(options, name(), *mechanism_, parameters);
  const auto wall = std::chrono::steady_clock::now();
  const double cpu = thread_cpu_seconds();
  const std::shared_ptr<const PreparedScene> prepared = prepared_for(parameters);
  const StandingDisplacement standing = prepared->standing(parameters);
  RunResult result = prepared->scene().layout().n == 0 ? without_play(*prepared, standing, parameters, options)
                                                       : follow(*prepared, standing, parameters, options);
  if (standing && !result.interrupted) {
    const PerQuantity missed = standing_model_error(*mechanism_, *prepared, standing, parameters, result.index);
    for (int k = 0; k < kPointingQuantities; ++k) result.error.model[k] += missed[k];
    result.error.basis += (result.error.basis.empty() ? "" : "; ") + std::string(kBasisOfErrors);
  }
  result.warnings.insert(result.warnings.begin(), prepared->held().begin(), prepared->held().end());
  if (const std::string doubt = doubt_of(prepared->ideal()); !doubt.empty()) result.warnings.push_back(doubt);
  const SceneLayout& layout = prepared->scene().layout();
  if (prepared->scene().tips())
    result.warnings.push_back(tipping_sentence(*mechanism_, layout));
  else if (starts_somewhere())
    if (const std::string undecided = undecided_sentence(*mechanism_, layout); !undecided.empty())
      result.warnings.push_back(undecided);
  result.rung = name();
  result.cost.cpu_seconds = thread_cpu_seconds() - cpu;
  result.cost.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  return result;
}

}  // namespace boresight
