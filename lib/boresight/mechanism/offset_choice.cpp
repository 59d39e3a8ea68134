#include "boresight/mechanism/offset_choice.hpp"

#include <algorithm>

#include "boresight/math/singular_values.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/generic_instant.hpp"
#include "boresight/mechanism/multibody_advice.hpp"
#include "boresight/mechanism/rank_analysis.hpp"

namespace boresight {
namespace {

// Share of a row in motions that no row chosen before sees, from which on a joint's own offsets are coordinates before those
// of other joints.
constexpr double kPlainlyIndependent = 0.1;

// Rows that tell the motions of the null space apart, the one that sees most of what is left first; offsets before joints.
void choose(const OffsetLayout& layout, const std::vector<MatX>& rows, const MatX& null_space, OffsetChoice& choice) {
  struct Candidate {
    int constraint, row;
    VecX seen;  // the row's share in each motion left, less what chosen rows see already
  };
  const int freedoms = static_cast<int>(null_space.cols());
  const auto take = [&](int first, int last) {
    std::vector<Candidate> candidates;
    for (int k = first; k < last; ++k)
      for (Eigen::Index i = 0; i < rows[k].rows(); ++i)
        candidates.push_back(
            {k, static_cast<int>(i), null_space.transpose() * rows[k].row(i).transpose().normalized()});
    return candidates;
  };
  std::vector<OffsetChoice::Chosen>& chosen = choice.chosen;
  MatX basis(freedoms, 0);
  const int clearances = layout.clearances();
  // Adds rows that see something which those chosen before do not, the one that sees most of it first.
  const auto add = [&](std::vector<Candidate> candidates, double least) {
    while (basis.cols() < freedoms) {
      const Candidate* best = nullptr;
      double largest = least;
      for (Candidate& c : candidates) {
        const VecX rest = c.seen - basis * (basis.transpose() * c.seen);
        if (rest.norm() > largest) largest = rest.norm(), best = &c;
      }
      if (!best) break;
      VecX rest = best->seen - basis * (basis.transpose() * best->seen);
      rest -= basis * (basis.transpose() * rest);
      basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
      basis.rightCols(1) = rest.normalized();
      chosen.push_back({best->constraint, best->row});
    }
  };
  for (int c = 0; c < clearances; ++c) add(take(c, c + 1), kPlainlyIndependent);
  add(take(0, clearances), kRankTolerance);
  const std::size_t offsets = chosen.size();
  add(take(clearances, static_cast<int>(rows.size())), kRankTolerance);
  choice.leftover = static_cast<int>(chosen.size() - offsets);
  if (basis.cols() < freedoms)
    throw ComputationError("the mechanism can move in " + std::to_string(freedoms - basis.cols()) +
                           " way(s) that no coordinate of a joint describes" + kUseMultibody);
  // Offsets in the order of the layout.
  std::stable_sort(chosen.begin(), chosen.end() - choice.leftover,
                   [](const OffsetChoice::Chosen& a, const OffsetChoice::Chosen& b) {
                     return a.constraint != b.constraint ? a.constraint < b.constraint : a.row < b.row;
                   });
  for (std::size_t z = 0; z + choice.leftover < chosen.size(); ++z) {
    const OffsetLayout::Joint& joint = layout.joint(chosen[z].constraint);
    for (int k = 0; k < joint.count(); ++k)
      if (joint.released(k) && joint.released_row(k) == chosen[z].row)
        choice.source[joint.first + k] = static_cast<int>(z);
  }
}

}  // namespace

std::vector<bool> OffsetChoice::dependent_rows(const OffsetLayout& layout, int clearance) const {
  const OffsetLayout::Joint& joint = layout.joint(clearance);
  std::vector<bool> dependent(joint.count() - joint.slides, false);
  for (int k = 0; k < joint.count(); ++k)
    if (joint.released(k)) dependent[joint.released_row(k)] = source[joint.first + k] == kDependent;
  return dependent;
}

std::vector<JointConstraint> rows_that_may_be_chosen(const Mechanism& mechanism) {
  std::vector<JointConstraint> rows;
  for (int c = 0; c < mechanism.clearances(); ++c)
    rows.emplace_back(mechanism, mechanism.description().clearances[c].joint, ClearanceRows::released, false);
  for (int j = 0; j < mechanism.joints(); ++j) rows.emplace_back(mechanism, j, ClearanceRows::free, false);
  return rows;
}

OffsetChoice choose_offsets(const Mechanism& mechanism, const IdealMotion& ideal) {
  if (mechanism.offset_choice()) return *mechanism.offset_choice();
  OffsetChoice choice;
  const OffsetLayout layout(mechanism);
  ConstraintSystem closed(mechanism, {.clearance = ClearanceRows::closed, .drives = true});
  IdealState state;
  std::vector<TimeValue> laws(mechanism.joints());
  ideal.state(generic_instant(0.0, ideal.duration()), state);
  ideal.drive_laws(state.t, laws);
  closed.evaluate(state.bodies, laws);
  // By rank: factors of J W J^T exist for rows that depend on each other too, as rounding has it.
  choice.all = closed.row_count() == 6 * mechanism.bodies() && constraint_rank(mechanism, closed) == closed.row_count();
  choice.source.assign(layout.size(), OffsetChoice::kDependent);
  if (choice.all) {
    for (int c = 0; c < layout.clearances(); ++c)
      for (int k = 0; k < layout.joint(c).count(); ++k)
        if (layout.joint(c).released(k)) {
          choice.source[layout.joint(c).first + k] = static_cast<int>(choice.chosen.size());
          choice.chosen.push_back({c, layout.joint(c).released_row(k)});
        }
  } else {
    const double length = mechanism.characteristic_length();
    ConstraintSystem open(mechanism, {.clearance = ClearanceRows::open, .drives = true});
    open.evaluate(state.bodies, laws);
    const MatX kept = scaled_rows(open.dense_jacobian(), length);
    std::vector<MatX> rows;
    for (const JointConstraint& c : rows_that_may_be_chosen(mechanism))
      rows.push_back(scaled_rows(stacked_rows(c, state.bodies), length));
    if (kept.rows() == 0) {
      choose(layout, rows, MatX::Identity(kept.cols(), kept.cols()), choice);
    } else {
      const auto [sigma, V] = singular_decomposition(kept);
      const Eigen::Index rank = (sigma.array() > kRankTolerance * sigma[0]).count();
      choose(layout, rows, V.rightCols(kept.cols() - rank), choice);
    }
  }
  for (int c = 0; c < layout.clearances(); ++c)
    for (int k = 0; k < layout.joint(c).count(); ++k)
      if (!layout.joint(c).released(k)) choice.source[layout.joint(c).first + k] = OffsetChoice::kSlides;
  for (const int s : choice.source) choice.has_dependent = choice.has_dependent || s == OffsetChoice::kDependent;
  return choice;
}

}  // namespace boresight
