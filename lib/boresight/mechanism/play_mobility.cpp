#include "boresight/mechanism/play_mobility.hpp"

#include <algorithm>
#include <numeric>

#include "boresight/math/singular_values.hpp"
#include "boresight/mechanism/constraint_system.hpp"
#include "boresight/mechanism/rank_analysis.hpp"

namespace boresight {
namespace {

// Rows are of order one once scaled, and the basis is orthonormal: what is left of a row in it is a pure number.
constexpr double kNothing = 1e-7;

// Motions of all bodies (scaled, orthonormal columns) that the rows allow.
MatX allowed_motions(const MatX& rows) {
  if (rows.rows() == 0) return MatX::Identity(rows.cols(), rows.cols());
  const auto [sigma, V] = singular_decomposition(rows);
  const Eigen::Index rank = (sigma.array() > kRankTolerance * sigma[0]).count();
  return V.rightCols(rows.cols() - rank);
}

int rank_in(const MatX& rows, const MatX& motions) {
  if (rows.rows() == 0 || motions.cols() == 0) return 0;
  return static_cast<int>((singular_values(rows * motions).array() > kNothing).count());
}

// A joint's released rows, scaled, each of unit length.
MatX released_rows(const Mechanism& mechanism, int joint, const std::vector<BodyMotion>& bodies) {
  const JointConstraint constraint(mechanism, joint, ClearanceRows::released, false);
  return scaled_rows(stacked_rows(constraint, bodies), mechanism.characteristic_length()).rowwise().normalized();
}

MatX stacked(const std::vector<MatX>& rows, const std::vector<int>& which, Eigen::Index columns) {
  MatX all(0, columns);
  for (int c : which) {
    all.conservativeResize(all.rows() + rows[c].rows(), Eigen::NoChange);
    all.bottomRows(rows[c].rows()) = rows[c];
  }
  return all;
}

// "A", "A" and "B", "A", "B" and "C".
std::string names(const std::vector<std::string>& all) {
  std::string text;
  for (std::size_t i = 0; i < all.size(); ++i)
    text += (i == 0 ? "" : i + 1 < all.size() ? ", " : " and ") + ('"' + all[i] + '"');
  return text;
}

std::string joint_name(const Mechanism& mechanism, int joint) { return mechanism.description().joints[joint].name; }

std::string clearance_name(const Mechanism& mechanism, int clearance) {
  return joint_name(mechanism, mechanism.description().clearances[clearance].joint);
}

std::string holders(const Mechanism& mechanism, const PlayMobility::Joint& joint) {
  if (joint.held_by.empty()) return "other joints hold";
  std::vector<std::string> all;
  for (int j : joint.held_by) all.push_back(joint_name(mechanism, j));
  if (all.size() > 3) return "the loop of " + names({all[0], all[1]}) + " and others holds";
  return names(all) + (all.size() == 1 ? " holds" : " hold");
}

}  // namespace

bool PlayMobility::any_held() const {
  for (std::size_t c = 0; c < joint.size(); ++c)
    if (held(static_cast<int>(c))) return true;
  return false;
}

PlayMobility analyse_play(const Mechanism& mechanism, const std::vector<BodyMotion>& bodies) {
  const int clearances = mechanism.clearances();
  PlayMobility result;
  result.joint.resize(clearances);
  if (clearances == 0) return result;
  ConstraintSystem open(mechanism, {.clearance = ClearanceRows::open, .drives = true});
  open.evaluate(bodies, std::vector<TimeValue>(mechanism.joints()));
  const MatX kept = scaled_rows(open.dense_jacobian(), mechanism.characteristic_length());
  const MatX motions = allowed_motions(kept);
  std::vector<MatX> released;
  for (int c = 0; c < clearances; ++c) {
    released.push_back(released_rows(mechanism, mechanism.description().clearances[c].joint, bodies));
    result.joint[c].offsets = static_cast<int>(released[c].rows());
    result.joint[c].movable = rank_in(released[c], motions);
  }

  // What holds a play: the joints without which it moves further.
  if (result.any_held()) {
    Eigen::Index first = 0;
    for (const JointConstraint& joint : open.joints()) {
      const Eigen::Index n = joint.count();
      MatX rest(kept.rows() - n, kept.cols());
      rest << kept.topRows(first), kept.bottomRows(kept.rows() - first - n);
      first += n;
      const MatX freer = allowed_motions(rest);
      for (int c = 0; c < clearances; ++c)
        if (result.held(c) && joint.joint() != mechanism.description().clearances[c].joint &&
            rank_in(released[c], freer) > result.joint[c].movable)
          result.joint[c].held_by.push_back(joint.joint());
    }
  }

  // Plays that hang together: a play belongs to a group if the group without it has less rank left over than with it.
  std::vector<int> all;
  for (int c = 0; c < clearances; ++c)
    if (result.joint[c].movable > 0) all.push_back(c);
  const auto excess = [&](const std::vector<int>& which) {
    int sum = 0;
    for (int c : which) sum += result.joint[c].movable;
    return sum - rank_in(stacked(released, which, kept.cols()), motions);
  };
  while (excess(all) > 0) {
    // A smallest group: leave out whatever is not needed for its members to hang on each other.
    std::vector<int> group = all;
    for (int c : all) {
      std::vector<int> without = group;
      std::erase(without, c);
      if (excess(without) > 0) group = without;
    }
    // And everything else that hangs on it.
    for (bool grew = true; grew;) {
      grew = false;
      for (int c : all) {
        if (std::find(group.begin(), group.end(), c) != group.end()) continue;
        std::vector<int> with = group;
        with.push_back(c);
        if (excess(with) > excess(group)) group = with, grew = true;
      }
    }
    std::sort(group.begin(), group.end());
    result.together.push_back(group);
    result.independent.push_back(rank_in(stacked(released, group, kept.cols()), motions));
    for (int c : group) std::erase(all, c);
  }
  return result;
}

std::vector<std::string> held_plays(const Mechanism& mechanism, const PlayMobility& play) {
  std::vector<std::string> sentences;
  for (int c = 0; c < mechanism.clearances(); ++c) {
    const PlayMobility::Joint& joint = play.joint[c];
    if (joint.movable > 0 || joint.offsets == 0) continue;
    sentences.push_back("the play of \"" + clearance_name(mechanism, c) +
                        "\" cannot move: " + holders(mechanism, joint) +
                        " the same parts without play; it adds nothing to the pointing error");
  }
  return sentences;
}

std::vector<std::string> bound_plays(const Mechanism& mechanism, const PlayMobility& play) {
  std::vector<std::string> sentences;
  for (int c = 0; c < mechanism.clearances(); ++c) {
    const PlayMobility::Joint& joint = play.joint[c];
    if (joint.movable == 0 || !play.held(c)) continue;
    sentences.push_back("the play of \"" + clearance_name(mechanism, c) + "\" moves in " +
                        std::to_string(joint.movable) + " of " + std::to_string(joint.offsets) +
                        " ways only: " + holders(mechanism, joint) + " the rest");
  }
  for (std::size_t g = 0; g < play.together.size(); ++g) {
    std::vector<std::string> all;
    int offsets = 0;
    for (int c : play.together[g]) {
      all.push_back(clearance_name(mechanism, c));
      offsets += play.joint[c].movable;
    }
    sentences.push_back("the plays of " + names(all) + " move together: " + std::to_string(play.independent[g]) +
                        " of their " + std::to_string(offsets) + " offsets are independent, the others follow");
  }
  return sentences;
}

}  // namespace boresight
