// What the cheap rungs share: the ideal motion and the scene of a mechanism, computed on first use and kept for all samples.
#pragma once

#include <map>
#include <memory>
#include <mutex>

#include "boresight/rungs/rung.hpp"
#include "boresight/scene/clearance_scene.hpp"
#include "boresight/scene/standing_loads.hpp"

namespace boresight {

// Whether two sets of parameters share what the whole scene hangs on: where masses have their centres.
bool same_centers(const Parameters& a, const Parameters& b);
// Whether they share what the scene's tables hang on, and the ideal motion where it is simulated: these, masses, gravity, springs.
bool same_scene(const Parameters& a, const Parameters& b);

// A mechanism's ideal motion and scene, and what is read off them again and again. Safe to share between threads.
class PreparedScene {
 public:
  // accuracy: ClearanceScene's.
  PreparedScene(const Mechanism& mechanism, IdealMotion ideal_motion, const Parameters& parameters,
                double accuracy = ClearanceScene::kAccuracy);

  const IdealMotion& ideal() const { return ideal_; }
  const ClearanceScene& scene() const { return scene_; }
  // Sentences on plays that cannot move.
  const std::vector<std::string>& held() const { return held_; }
  // In which the fastest body of the ideal motion turns by a radian or moves by the mechanism's size [s]: motion_scales.hpp.
  double own_time() const { return own_time_; }
  // In which a load changes by all that it does [s]: load_time.hpp.
  double load_time() const { return scene_.load_time(); }
  // The same of each error's law, one by one: error_times().
  const std::vector<double>& error_times() const;
  // Tables of these masses, gravity, springs; the last ones asked for are kept.
  std::shared_ptr<const SceneTables> tables(const Parameters& parameters) const;
  // The same with what this sample's errors change of the loads, and where they leave the offsets that redundant joints tie to others.
  std::shared_ptr<const SceneTables> tables(const Parameters& parameters, const StandingDisplacement& standing) const;
  // E of a body over time: 6 x n, row by row.
  const TimeTable& pose_gain(int body) const;
  // Its rate of change, likewise.
  const TimeTable& pose_gain_rate(int body) const;
  // What this sample's standing errors displace bodies by. Throws what StandingErrors throws.
  StandingDisplacement standing(const Parameters& parameters) const;
  // What these errors change of the loads on the coordinates: as forces, and as accelerations by the mass of these tables.
  StandingLoads::Change changed_loads(const Parameters& parameters, const StandingDisplacement& standing) const;
  StandingLoads::Change changed_accelerations(const Parameters& parameters, const StandingDisplacement& standing,
                                              const SceneTables& accelerations) const;

 private:
  const Mechanism& mechanism_;
  IdealMotion ideal_;
  ClearanceScene scene_;
  std::vector<std::string> held_;
  double own_time_;
  mutable std::mutex mutex_;
  mutable Parameters tabled_;
  mutable std::shared_ptr<const SceneTables> tables_;
  mutable std::map<int, TimeTable> pose_gain_, pose_gain_rate_;
  mutable std::shared_ptr<const StandingErrors> errors_;
  mutable std::shared_ptr<const StandingLoads> loads_;
  mutable std::once_flag error_times_once_;
  mutable std::vector<double> error_times_;
};

// Whether a scene that was prepared with other parameters holds for these.
bool serves(const Mechanism& mechanism, const PreparedScene& kept, const Parameters& its_own,
            const Parameters& parameters);

// Bodies of the ideal motion displaced by the deviation x = E z + G eps, at one instant: x moves the body, its turning part theta
// makes R = exp(theta) R_ideal. To first order in theta
//   v = v_ideal + x'       w = w_ideal + theta' + theta x w_ideal
//   a = a_ideal + x''  alpha = alpha_ideal + theta'' + theta' x w_ideal + theta x alpha_ideal
// with x' = E z' + E' z + G' eps and x'' = E z'' + 2 E' z' + E'' z + G'' eps.
class DisplacedBodies {
 public:
  DisplacedBodies(const PreparedScene& prepared, const StandingDisplacement& standing, double t,
                  const Eigen::Ref<const VecX>& z)
      : prepared_(prepared), standing_(standing), t_(t), z_(z) {}

  // E z + G eps of a body.
  Vec6 displacement(int body) const;
  // With the velocities and the acceleration of the ideal motion.
  BodyMotion at_rest(int body, BodyAcceleration& acceleration) const;
  // With those of the deviation added.
  BodyMotion moving(int body, const Eigen::Ref<const VecX>& z_dot, const Eigen::Ref<const VecX>& z_ddot,
                    BodyAcceleration& acceleration) const;

 private:
  using PoseGain = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>;
  PoseGain gain(const TimeTable& table) const;

  const PreparedScene& prepared_;
  const StandingDisplacement& standing_;
  double t_;
  Eigen::Ref<const VecX> z_;
};

class SceneRung : public Rung {
 public:
  // Times the computation, then hands over to follow().
  RunResult run(const Parameters& parameters, const RunOptions& options) const final;

 protected:
  explicit SceneRung(std::shared_ptr<const Mechanism> mechanism) : mechanism_(std::move(mechanism)) {}
  virtual RunResult follow(const PreparedScene& prepared, const StandingDisplacement& standing,
                           const Parameters& parameters, const RunOptions& options) const = 0;
  // Whether what follows hangs on where the journals start.
  virtual bool starts_somewhere() const { return true; }
  const Mechanism& mechanism() const { return *mechanism_; }

 private:
  std::shared_ptr<const PreparedScene> prepared_for(const Parameters& parameters) const;
  RunResult without_play(const PreparedScene& prepared, const StandingDisplacement& standing,
                         const Parameters& parameters, const RunOptions& options) const;

  std::shared_ptr<const Mechanism> mechanism_;
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const PreparedScene> prepared_;
  mutable Parameters prepared_parameters_;
};

}  // namespace boresight
