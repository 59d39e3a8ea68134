// The joints' part of a row of a clearance scene: relative spins and slides of the journals, ideal and per coordinate rate; where gains move,
// what the coordinates themselves add. What the coordinates add to a twist is what their rates add to its spin. And the offsets that follow
// from others.
#include <algorithm>

#include "boresight/math/cross_matrix.hpp"
#include "boresight/mechanism/joint_rows.hpp"
#include "boresight/scene/clearance_scene.hpp"
#include "boresight/scene/table_row.hpp"

namespace boresight {
namespace {

// What sums of rates cancel to is noise, which no finer grid makes smooth.
void drop_rounding(const MatX& rounding, MatX& sum) { sum = (sum.array().abs() > rounding.array()).select(sum, 0.0); }

}  // namespace

void ClearanceScene::add_joints(const MatX& B_rate, Knot& knot) const {
  const MechanismDescription& m = mechanism_.description();
  const int n = layout_.n;
  const bool gains_move =
      std::any_of(layout_.joints.begin(), layout_.joints.end(), [](const auto& at) { return at.gains_move; });
  const MatX rounding = gains_move ? coordinates_.rounding_of_rates(knot.T) : MatX();
  for (int c = 0; c < mechanism_.clearances(); ++c) {
    const SceneLayout::Joint& at = layout_.joints[c];
    const ClearanceDescription& d = m.clearances[c];
    const JointGeometry& g = mechanism_.geometry(d.joint);
    const bool journal_first = d.journal == m.joints[d.joint].first;
    const JointFrame &sleeve = journal_first ? g.second : g.first, &journal = journal_first ? g.first : g.second;
    static const BodyMotion at_rest;
    const auto motion = [&](int body) -> const BodyMotion& {
      return body == kGround ? at_rest : knot.state.bodies[body];
    };
    const auto gain = [&](const MatX& of, int body) -> MatX {
      return body == kGround ? MatX(MatX::Zero(6, n)) : MatX(of.middleRows<6>(6 * body));
    };
    const BodyMotion &S = motion(sleeve.body), &J = motion(journal.body);
    MatX roundS, roundJ;
    if (at.gains_move) roundS = gain(rounding, sleeve.body), roundJ = gain(rounding, journal.body);
    const MatX TS = gain(knot.T, sleeve.body), TJ = gain(knot.T, journal.body);
    const MatX TdS = gain(knot.T_rate, sleeve.body), TdJ = gain(knot.T_rate, journal.body);
    const Mat3 R_WS = S.R * sleeve.R;
    const Vec3 spin = R_WS.transpose() * (J.w - S.w);
    const MatX spin_gain = R_WS.transpose() * (TJ.bottomRows<3>() - TS.bottomRows<3>());
    if (at.spins == 3) {
      append(knot.joints, spin);
      append(knot.joints, spin_gain);
    } else {
      knot.joints.push_back(spin.y());
      append(knot.joints, spin_gain.row(1));
    }
    if (at.gains_move) {
      // w of a body turned by theta = T_w z is w_ideal + thetadot + theta x w_ideal, and the sleeve's axes turn with it.
      MatX drift = R_WS.transpose() * (TdJ.bottomRows<3>() - TdS.bottomRows<3>() -
                                       cross_matrix(J.w) * (TJ.bottomRows<3>() - TS.bottomRows<3>()));
      drop_rounding(R_WS.transpose().cwiseAbs() * (roundJ + roundS).bottomRows<3>(), drift);
      if (at.spins == 3)
        append(knot.joints, drift);
      else
        append(knot.joints, drift.row(1));
    }
    if (at.slides > 0) {
      using Gain = Eigen::Matrix<double, 3, Eigen::Dynamic>;
      const Vec3 rS = S.R * sleeve.p, rJ = J.R * journal.p, distance = J.p + rJ - S.p - rS;
      const Vec3 distance_rate = J.v + J.w.cross(rJ) - S.v - S.w.cross(rS + distance);
      const Gain across = TJ.topRows<3>() - cross_matrix(rJ) * TJ.bottomRows<3>() - TS.topRows<3>() +
                          cross_matrix(rS + distance) * TS.bottomRows<3>();
      const std::vector<int> axes = at.slides == 1 ? std::vector<int>{1} : std::vector<int>{0, 2};
      for (const int axis : axes) {
        knot.joints.push_back(R_WS.col(axis).dot(distance));
        knot.joints.push_back(R_WS.col(axis).dot(distance_rate));
      }
      for (const int axis : axes) append(knot.joints, Eigen::RowVectorXd(R_WS.col(axis).transpose() * across));
      if (at.gains_move) {
        const Vec3 rJ_rate = J.w.cross(rJ), on_sleeve_rate = J.v + rJ_rate - S.v;  // of rS + distance
        const Gain across_rate = TdJ.topRows<3>() - cross_matrix(rJ_rate) * TJ.bottomRows<3>() -
                                 cross_matrix(rJ) * TdJ.bottomRows<3>() - TdS.topRows<3>() +
                                 cross_matrix(on_sleeve_rate) * TS.bottomRows<3>() +
                                 cross_matrix(rS + distance) * TdS.bottomRows<3>();
        for (const int axis : axes) {
          const Vec3 along = R_WS.col(axis);
          MatX drift = S.w.cross(along).transpose() * across + along.transpose() * across_rate;
          drop_rounding(along.cwiseAbs().transpose() *
                            (roundJ.topRows<3>() + cross_matrix(rJ).cwiseAbs() * roundJ.bottomRows<3>() +
                             roundS.topRows<3>() + cross_matrix(rS + distance).cwiseAbs() * roundS.bottomRows<3>()),
                        drift);
          append(knot.joints, drift);
        }
      }
    }
    if (at.twists) append(knot.joints, twist_of_insert(mechanism_, c, knot.state.bodies));
    if (at.has_dependent) {
      append(knot.joints, knot.B.middleRows(offsets_.joint(c).first, at.offsets));
      append(knot.joints, B_rate.middleRows(offsets_.joint(c).first, at.offsets));
      // Of the drawn mechanism zero; of a built one, whose play has taken up errors, where its dependent offsets stand.
      JointRows rows;
      if (mechanism_.built())
        JointConstraint(mechanism_, d.joint, ClearanceRows::released, false).evaluate(knot.state.bodies, {}, rows);
      for (const Vec6* part : {&rows.value, &rows.rate})
        for (int k = 0; k < at.offsets; ++k)
          knot.joints.push_back(
              at.source[k] == DeviationCoordinates::kDependent ? (*part)[offsets_.joint(c).released_row(k)] : 0.0);
    }
  }
}

}  // namespace boresight
