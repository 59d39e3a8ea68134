// Coordinates for the small deviation of a mechanism, opened at its clearance joints, from its ideal motion.
//
// With K the rows that stay in force (drives included) and S as many rows as there are freedoms left, [K; S] is square and
//     T = [K; S]^-1 restricted to S
// holds the velocities of all bodies per unit rate of the coordinates z, the deviation of the bodies being T z. The rows of S are those
// of offset_choice.hpp: the joints' offsets themselves, and freedoms that nothing drives. An offset that is no coordinate is zero or
// follows the others, xi = B z with B = R T, R the released rows. There may be no coordinate at all, where no play can move.
// Default scene: one revolute joint, three coordinates, its offsets.
#pragma once

#include <string>
#include <vector>

#include "boresight/math/orthogonal_factors.hpp"
#include "boresight/mechanism/offset_choice.hpp"

namespace boresight {

class DeviationCoordinates {
 public:
  // Throws ComputationError where no joint's coordinates describe what the mechanism can do.
  DeviationCoordinates(const Mechanism& mechanism, const IdealMotion& ideal);
  // Of coordinates that have been chosen, of this mechanism or of one that it was built from.
  DeviationCoordinates(const Mechanism& mechanism, const IdealMotion& ideal, OffsetChoice choice);

  int count() const { return count_; }
  // Coordinates that are no offsets come last: so many.
  int leftover() const { return leftover_; }

  // Where an offset of OffsetLayout comes from: its coordinate, or one of these.
  static constexpr int kSlides = OffsetChoice::kSlides;        // it is no offset
  static constexpr int kDependent = OffsetChoice::kDependent;  // B z
  const std::vector<int>& source() const { return source_; }
  bool has_dependent() const { return has_dependent_; }

  // T at t: 6 bodies x count. Throws ComputationError, naming the time, near a singular pose.
  void gain(double t, MatX& T);
  // The same at a pose of this mechanism, whatever the ideal motion has there.
  void gain(const IdealState& state, MatX& T);
  // B at the pose of the last gain(): offsets x count. Exactly 0 and 1 where an offset is a coordinate.
  MatX offsets_per_coordinate(const MatX& T) const;
  // How fast T and B change there along the ideal motion; where offsets depend on others also how T_rate changes, else 0 x 0.
  void rates(const MatX& T, MatX& T_rate, MatX& T_second, MatX& B_rate);
  // After rates(): what of each entry of T_rate may be rounding, size of T.
  MatX rounding_of_rates(const MatX& T) const;
  // The chosen rows at the pose of the last gain(), in the order of the coordinates: acceleration of z = rows . v' - gamma.
  void coordinate_accelerations(const std::vector<BodyMotion>& bodies,
                                const std::vector<BodyAcceleration>& acceleration, VecX& z_ddot) const;
  // Rates of the chosen rows, and their values, of given body motions.
  void coordinate_rates(const std::vector<BodyMotion>& bodies, VecX& z_dot, VecX& z) const;
  // What bodies do beyond the ideal motion: the same, less what the ideal motion has of the coordinates that are no offsets. Without
  // accelerations z_ddot stays empty.
  struct Deviation {
    VecX z, z_dot, z_ddot;
  };
  Deviation deviation(const IdealState& ideal, const std::vector<BodyMotion>& bodies,
                      const std::vector<BodyAcceleration>& acceleration) const;

 private:
  void gain_here(MatX& T);
  void sparse_gain(MatX& T);
  void dense_gain(double t, MatX& T);
  void solve_closed(Eigen::Ref<VecX> motion);
  MatX dense_rows(const std::vector<BodyMotion>& bodies);
  [[noreturn]] void throw_singular(double t) const;

  const Mechanism& mechanism_;
  const IdealMotion& ideal_;
  OffsetLayout layout_;
  ConstraintSystem closed_, open_, moved_;
  bool sparse_;  // OffsetChoice::all
  std::vector<Mat6> weight_;
  double length_;
  // Of the fastest body at the last rates(), in turns and lengths of the mechanism's size a second.
  double speed_ = 0.0;
  VecX scale_;  // kinematic weight of the stacked velocities
  VecX unit_;   // of each coordinate: the characteristic length of a distance, 1 of a turn or a slope
  std::vector<JointConstraint> rows_;  // that may be chosen
  std::vector<OffsetChoice::Chosen> chosen_;
  std::vector<int> source_;
  bool has_dependent_;
  int count_, leftover_;
  IdealState state_;
  std::vector<TimeValue> laws_;
  std::vector<Vec6> b_, goal_, u_, residual_, du_;
  MatX all_;  // rows of the last dense gain, and how they were solved
  Eigen::ColPivHouseholderQR<MatX> qr_;
};

}  // namespace boresight
