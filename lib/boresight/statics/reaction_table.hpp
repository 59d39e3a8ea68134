// The ideal joints' reactions r(t) and the pose gain E(t) of one set of parameters, instant by instant: what the rungs
// without dynamics walk along.
#pragma once

#include <vector>

#include "boresight/math/eight_point_table.hpp"
#include "boresight/play/joint_play.hpp"
#include "boresight/rungs/run_result.hpp"
#include "boresight/scene/scene_rung.hpp"

namespace boresight {

inline constexpr int kInstantsBetweenLooks = 256;  // at whether to go on

class ReactionTable {
 public:
  // share: of the spacing that instants have by default. Throws ComputationError where the mechanism has freedoms that nothing drives,
  // which do not rest at all.
  ReactionTable(const Mechanism& mechanism, const PreparedScene& prepared, const StandingDisplacement& standing,
                const Parameters& parameters, double share = 1.0);

  struct Load {
    PlayOffsets force;       // on the journal's offsets; zero where an offset is none [N, N m]
    bool slides = false;     // along its axis:
    JointCoordinates joint;  // by so much in the ideal motion, and twisted so
    VecX slide_gain;         // and what coordinates add to it
  };
  struct Instant {
    double t;
    VecX reaction;                                       // on the coordinates
    Eigen::Matrix<double, 6, Eigen::Dynamic> pose_gain;  // E of the boresight body, per coordinate
    std::vector<Load> load;                              // per clearance
  };
  int instants() const { return instants_; }
  double spacing() const { return spacing_; }  // of instants [s]
  Instant at(int instant) const { return at_time(instant * spacing_); }
  Instant at_time(double t) const;
  const std::vector<JointPlay>& joints() const { return joints_; }
  // Whether offsets hang on each other (redundant joints, or standing errors that use up their play), so that no joint rests on its own:
  // tied_rest.hpp.
  bool tied() const { return tied_; }
  // Whether joints with play slide along their axes: where their journals rest moves those of others, by second order.
  bool slides() const { return slides_; }
  // Loads that are known no better than zero, as a share of what the bodies that the coordinate moves weigh and resist on it (without
  // regard to sign, so that what cancels counts), and no more than that of the largest load of all. A light part at the end of heavy ones
  // has its loads told apart by its own weight.
  static constexpr double kRounding = 10.0 * ClearanceScene::kAccuracy;
  // A load below is what rounding leaves of loads that cancel, along the whole motion [N].
  double cancelled() const { return cancelled_; }
  // Whether a load is known well enough for its direction: the tables are accurate to a hundred-thousandth of the largest.
  bool decides(const Instant& instant, int clearance) const;
  // E of one joint's offsets: 6 x 5, zero columns where an offset is none.
  Eigen::Matrix<double, 6, kMostOffsets> joint_gain(const Instant& instant, int clearance) const;
  // Coordinates of journals at rest.
  VecX coordinates(const std::vector<RestingPlay>& rest) const;

  const std::string& joint_name(int clearance) const;

 private:
  void find_least_loads(const PreparedScene& prepared, const Parameters& parameters);

  const Mechanism& mechanism_;
  SceneLayout layout_;
  int instants_;
  double spacing_;
  EightPointTable
      table_;         // r (n), E (6 x n), per clearance its slide and what coordinates add to it (n), and its twist (2)
  TimeTable change_;  // of r by standing errors (n, or no functions)
  std::vector<JointPlay> joints_;
  std::vector<OffsetGroups> groups_;  // of each
  std::vector<double> largest_load_;  // per clearance [N]
  double cancelled_ = 0.0;
  std::vector<std::vector<double>> least_;  // per clearance and group: a load below counts as none [N, N m]
  bool tied_ = false, slides_ = false;
};

}  // namespace boresight
