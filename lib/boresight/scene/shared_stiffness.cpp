// How contacts share the load where redundant joints tie offsets together, and what that makes of A K.
//
// What a load on a tied offset does to a freedom that nothing drives changes with the other offsets: a stage that stands on one corner of its
// pad turns another way than one that stands on all. So to first order in the deviation its turn hangs on the sharing, which the balance of
// forces leaves open and the contacts' elasticity decides.
#include "boresight/math/dense_solves.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/scene/clearance_scene.hpp"
#include "boresight/scene/deviation_stiffness.hpp"
#include "boresight/scene/resting_start.hpp"

namespace boresight {
namespace {

// On all offsets, as OffsetLayout has them; empty where no rest is found.
VecX loads_at_rest(const OffsetLayout& offsets, const RestingBalance& balance) {
  const RestingStart rest = balance.solve();
  if (!rest.refusal.empty()) return VecX();
  VecX loads = VecX::Zero(offsets.size());
  for (int c = 0; c < offsets.clearances(); ++c) {
    const std::size_t joint = static_cast<std::size_t>(c);
    loads.segment(offsets.joint(c).first, offsets.joint(c).count()) =
        balance.load_on(joint, balance.motion_of(joint, rest.z)).head(offsets.joint(c).count());
  }
  return loads;
}

}  // namespace

void ClearanceScene::let_contacts_share(const Parameters& parameters, const IdealMotion& ideal, double most_missed) {
  const std::vector<JointPlay> plays = joint_plays(mechanism_.description(), parameters);
  std::vector<MatX> least;
  std::vector<double> rows, row;
  bool rests = true;
  for (Knot& knot : knots_) {
    least.push_back(knot.stiffness);
    if (!rests) continue;
    work_reached("sharing loads between contacts",
                 static_cast<double>(least.size()) / static_cast<double>(knots_.size()));
    row.clear();
    append_row(parameters, knot, row, true);
    const VecX near = loads_at_rest(offsets_, RestingBalance(layout_, row.data(), plays));
    rests = near.size() > 0;
    if (!rests) continue;
    MatX T, M, C;
    VecX r;
    coordinates_.gain(knot.state, T);  // they know that instant's joints then
    assemble(parameters, knot, M, C, r);
    knot.stiffness = deviation_stiffness(mechanism_, ideal, parameters, coordinates_, knot.state, knot.T,
                                         solve_positive(M, C), r, near);
    append_row(parameters, knot, rows);
  }
  // Contacts that come and go share the load by leaps, which no table holds.
  if (rests && interpolation_error(rows, parameters) <= most_missed) return;
  for (std::size_t k = 0; k < knots_.size(); ++k) knots_[k].stiffness = std::move(least[k]);
}

}  // namespace boresight
