// Where the journals rest as a motion starts: the deviation z in which the contacts carry what the ideal joints carried,
//
//     r(0) + f_elastic(z) - K z = 0
//
// all joints together. Nothing moves against the ideal motion yet, so contacts neither dissipate nor rub. In directions in which
// no load acts offsets stay where the ideal motion has them: of all places that balance, the one nearest to there. Coordinates that are no offsets go where the bodies move least, weighed by
// their masses: which joints' coordinates these are hangs on the order of lists.
//
// The bodies start with the velocities of the ideal motion: start_rates.hpp.
//
// The balance is the minimum of the elastic energy less the work of the loads, which is convex but for the tilt of faces:
// Newton's method in offsets over clearances, damped (Levenberg 1944, Quarterly of Applied Mathematics 2, 164-168) where a
// step does not pay, from where each journal would rest alone.
//
// The same balance holds at any instant of a motion without vibration (the quasistatic rung), with the loads r(t): there from where the
// journals were a moment before.
#pragma once

#include <string>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight/play/joint_play.hpp"
#include "boresight/scene/clearance_scene.hpp"

namespace boresight {

struct RestingStart {
  VecX z;               // the coordinates: zero where there is no balance
  std::string refusal;  // why there is none; empty where there is one
};

// The balance at one instant: `row` holds the scene's numbers there (SceneTables::dynamics).
class RestingBalance {
 public:
  // cancelled: a load below is what rounding leaves of loads that cancel [N].
  RestingBalance(const SceneLayout& layout, const double* row, std::vector<JointPlay> joints, double cancelled = 0.0);
  // Of mechanisms all of whose coordinates are offsets, at one instant after the other: take() says which.
  RestingBalance(const SceneLayout& layout, std::vector<JointPlay> joints, double cancelled = 0.0);
  // Another instant. row: of it, read for gains, slides and shifts alone. reaction, stiffness: r and K as forces [N, N m; per m, per slope].
  void take(const double* row, const VecX& reaction, const MatX& stiffness);

  RestingStart solve() const;
  // The same from where the journals were a moment before, at coordinates and offsets: what nothing pushes stays there, as nearly as all joints'
  // offsets together can, whichever of them are coordinates. undecided: a load (size()) below which it is not known which way it points.
  RestingStart solve_near(const VecX& before, const std::vector<PlayOffsets>& offsets, double undecided);

  // What is left unbalanced with the offsets of z, F = r + f - K z, and its change with z: n, n x n [N, N m; per m, per slope].
  VecX left(const VecX& offsets) const;
  void evaluate(const VecX& offsets, VecX& F, MatX& by_z) const;
  // The latter where the journals stand as given, which a mechanism's own geometry may put a little off z.
  MatX stiffness_at(const std::vector<PlayMotion<double>>& journals) const;
  // The step of z that balances F: the shortest, in offsets over clearances, where contact holds no direction.
  VecX correction(const MatX& by_z, const VecX& F) const;
  // A load on z without the part that no journal's place can balance.
  VecX balanceable(const VecX& load) const { return with_offsets_.transpose() * load; }
  // z with the coordinates that are no offsets where the bodies move least.
  VecX completed(const VecX& z) const { return with_offsets_ * z; }
  // Of a step of z: the offsets that it makes, each over its clearance, as one length. It does not hang on which offsets are coordinates.
  double length(const VecX& dz) const { return unit_.triangularView<Eigen::Upper>().solve(dz).norm(); }
  // Of a load on z, likewise [N m].
  double size(const VecX& load) const { return (unit_.transpose() * load).norm(); }
  const MatX& unit() const { return unit_; }  // z = unit y: y of length 1 makes offsets of that length
  const std::vector<JointPlay>& joints() const { return joints_; }  // elastic, without friction
  PlayMotion<double> motion_of(std::size_t joint, const VecX& z) const;
  // What contact loads a joint's offsets with, these as they are in motion_of() [N, N m].
  PlayOffsets load_on(std::size_t joint, const PlayMotion<double>& motion) const;
  // Of a joint: its offsets are gain z + shift. 5 x n, 5.
  const MatX& offset_gain(std::size_t joint) const { return offsets_of_[joint]; }
  const PlayOffsets& offset_shift(std::size_t joint) const { return shift_[joint]; }
  // Whether loads tip journals over from a place with this change of what is left unbalanced.
  bool falls(const MatX& by_z) const { return at_.tips && steepest_way(by_z).size() > 0; }
  bool slides_along_axis(std::size_t joint) const { return at_.joints[joint].slides == 1; }
  // In the ideal motion: what the coordinates add to a twist moves contacts by a turn times a slope, of second order.
  const JointCoordinates& joint_coordinates(std::size_t joint) const { return coordinates_[joint]; }
  double load() const { return load_; }  // size() of the reactions [N m]

 private:
  void read(const double* row);
  void weigh();
  double energy(const VecX& offsets) const;
  VecX guess() const;
  // Newton's method, damped, from z on; undecided: what may be left where no step is; downhill: every step lowers the energy. Returns the
  // size of what is left.
  double descend(VecX& z, double undecided, bool downhill = false) const;
  // Where loads tip journals: from a balance that is a saddle of the energy to one that is none, of the two sides that it falls to the lower, and
  // either where they are alike. Returns the size of what is left.
  double off_the_saddle(VecX& z, double size_left) const;
  // The way of one clearance along which the energy falls most about a balance; empty where it falls nowhere.
  VecX steepest_way(const MatX& by_z) const;
  // The same where little has changed since the instant before: one step by its stiffness, then by one of now as long as they shrink fast.
  // Whether that found the balance.
  bool follow(VecX& z, double undecided);
  // Keeps the contacts' stiffness at z for follow(). Of a displacement, the part along which they hold nothing: n x n.
  MatX keep_stiffness(const VecX& z);
  // Along what holds nothing, from a balance to the nearest one to where the ideal motion has the journals: which of them Newton's method finds
  // hangs on rounding. What pushes along it next to not at all moves the journals in proportion. Whether that was found; else z is as it was.
  bool settle(VecX& z) const;
  void shorten(VecX& z, double allowed, double soft) const;
  VecX nearest(const VecX& coordinates, const std::vector<PlayOffsets>& offsets) const;

  const SceneLayout& at_;
  std::vector<JointPlay> joints_;
  MatX stiffness_;
  VecX reaction_;
  MatX unit_;                                  // upper triangle
  std::vector<bool> held_;                     // coordinates that the balance may move: offsets
  MatX with_offsets_;                          // n x n: z per offset, the others' columns zero
  std::vector<PlayOffsets> widths_;            // per joint: what each offset crosses its clearance with
  std::vector<MatX> offsets_of_;               // per joint: 5 x n, offsets per coordinate
  std::vector<MatX> over_widths_;              // the same over the widths, of coordinates that the balance may move
  std::vector<MatX> works_on_;                 // per joint: 6 x n, the offsets that force and couples work on
  std::vector<JointCoordinates> coordinates_;  // the joints' own
  std::vector<PlayOffsets> shift_;             // what standing errors leave of the offsets with all coordinates zero
  double load_ = 0.0, widest_ = 0.0, cancelled_ = 0.0;
  MatX kept_;  // z per load, where follow() was last
};

// The coordinates, and then their rates, that motions of this mechanism start with: zero where the file has the journals centred,
// else their balance. warning: a sentence where that was wanted and not found; else left alone.
VecX start_coordinates(const Mechanism& mechanism, const SceneLayout& layout, const SceneStart& start,
                       const std::vector<JointPlay>& joints, std::string& warning);
std::string centred_for_want_of(const Mechanism& mechanism, const std::string& refusal);

}  // namespace boresight
