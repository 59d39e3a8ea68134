#include "boresight/rungs/ideal_simulation.hpp"

#include <Eigen/QR>
#include <cmath>

#include "boresight/integrate/explicit_runge_kutta.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/rank_analysis.hpp"
#include "boresight/rungs/formulation.hpp"

namespace boresight {
namespace {

IdealState home_state(const Mechanism& mechanism) {
  IdealState state;
  const MechanismDescription& m = mechanism.description();
  state.bodies.resize(m.bodies.size());
  state.acceleration.assign(m.bodies.size(), Vec6::Zero());
  for (std::size_t b = 0; b < m.bodies.size(); ++b) {
    state.bodies[b].p = m.bodies[b].center_of_mass;
    state.bodies[b].R = m.bodies[b].axes;
  }
  return state;
}

// The row of a joint's freedom in the stacked velocities of all bodies, at home where both joint frames coincide.
Eigen::RowVectorXd freedom_row(const Mechanism& mechanism, const InitialRateDescription& rate) {
  const JointDescription& joint = mechanism.description().joints[rate.joint];
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(6 * mechanism.bodies());
  for (const auto& [body, sign] : {std::pair{joint.first, -1.0}, std::pair{joint.second, 1.0}}) {
    if (body == kGround) continue;
    const Vec3 r = joint.point - mechanism.description().bodies[body].center_of_mass;
    if (rate.freedom == InitialRateDescription::Freedom::angle)
      row.segment<3>(6 * body + 3) = sign * joint.axis.transpose();
    else
      row.segment<6>(6 * body) << sign * joint.axis.transpose(), sign * r.cross(joint.axis).transpose();
  }
  return row;
}

// Velocities at home: constraints and starting rates satisfied, everything else as slow as they allow.
void set_starting_rates(const Mechanism& mechanism, const std::vector<TimeValue>& laws, IdealState& state) {
  ConstraintSystem system(mechanism, {.clearance = ClearanceRows::closed});
  system.evaluate(state.bodies, laws);
  if (system.violation() > 1e-6 * mechanism.characteristic_length())
    throw ComputationError("the joints do not close at home, where a mechanism with free freedoms starts");
  const MatX J = system.dense_jacobian();
  const std::vector<InitialRateDescription>& rates = mechanism.description().initial_rates;
  MatX A(J.rows() + static_cast<Eigen::Index>(rates.size()), J.cols());
  VecX b = VecX::Zero(A.rows());
  A.topRows(J.rows()) = J;
  int row = 0;
  for (int k = 0; k < system.blocks(); ++k)
    for (int i = 0; i < system.joints()[k].count(); ++i) b[row++] = -system.rows(k).rate[i];
  for (const InitialRateDescription& rate : rates) {
    A.row(row) = freedom_row(mechanism, rate);
    b[row++] = rate.rate;
  }
  const VecX u = A.completeOrthogonalDecomposition().solve(b);
  if ((A * u - b).norm() > 1e-8 * std::max(1.0, b.norm()))
    throw InputError(rates.empty() ? mechanism.description().origin : rates.front().origin, "initial.rates",
                     "rates that contradict each other or the joints", "rates that the joints allow together");
  for (int k = 0; k < mechanism.bodies(); ++k) {
    state.bodies[k].v = u.segment<3>(6 * k);
    state.bodies[k].w = u.segment<3>(6 * k + 3);
  }
}

std::vector<IdealState> simulate(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion* drives,
                                 const IdealState& start, int steps) {
  // Joint coordinates: planar loops, redundant when drawn in space, are none in them, and singular positions are passed
  // with four digits more than in absolute coordinates.
  const auto formulation = make_tree_formulation(mechanism, parameters, drives, {.with_clearance = false});
  const std::vector<ContactMemory> none;
  VecX y;
  formulation->start(start, y);
  ExplicitRungeKutta method(classical_rk4(), y.size());
  const auto derivative = [&](double t, const VecX& state, VecX& dy) { formulation->derivative(t, state, none, dy); };
  const double h = mechanism.duration() / steps;
  std::vector<IdealState> knots;
  knots.reserve(steps + 1);
  for (int i = 0; i <= steps; ++i) {
    const double t = i * h;
    derivative(t, y, method.first_slope());
    if (!y.allFinite()) throw ComputationError("the ideal motion grew without bound before t = " + std::to_string(t) + " s");
    knots.push_back({t, formulation->bodies(t, y), formulation->acceleration()});
    if (i == steps) break;
    method.step(t, h, y, derivative);
    formulation->settle(t + h, y);
  }
  return knots;
}

double difference(const std::vector<IdealState>& coarse, const std::vector<IdealState>& fine, double length) {
  double worst = 0.0;
  for (std::size_t k = 0; k < coarse.size(); ++k)
    for (std::size_t b = 0; b < coarse[k].bodies.size(); ++b) {
      const BodyMotion &x = coarse[k].bodies[b], &y = fine[2 * k].bodies[b];
      worst = std::max({worst, (x.p - y.p).norm() / length, (x.R - y.R).norm()});
    }
  return worst;
}

}  // namespace

int undriven_freedoms(const Mechanism& mechanism) {
  if (mechanism.description().motion.pose) return 0;
  std::vector<TimeValue> laws(mechanism.joints());
  ConstraintSystem system(mechanism, {.clearance = ClearanceRows::closed});
  system.evaluate(home_state(mechanism).bodies, laws);
  const RankAnalysis rank = analyse_rank(mechanism, system, false);
  return static_cast<int>(rank.columns - rank.rank);
}

bool is_kinematic(const Mechanism& mechanism) {
  if (mechanism.description().motion.pose) return true;
  return mechanism.description().initial_rates.empty() && undriven_freedoms(mechanism) == 0;
}

IdealMotion ideal_motion(const Mechanism& mechanism, const Parameters& parameters) {
  if (is_kinematic(mechanism)) return IdealMotion::kinematic(mechanism);
  constexpr double kAgreement = 1e-9;
  constexpr int kFewestSteps = 1000, kMostSteps = 1 << 19;
  IdealState start = home_state(mechanism);
  // A motion that carries nothing but the drives' laws, which the simulation needs before there is a motion.
  const IdealMotion laws_only(mechanism, {start, [&] {
                                            IdealState end = start;
                                            end.t = mechanism.duration();
                                            return end;
                                          }()});
  std::vector<TimeValue> laws(mechanism.joints());
  laws_only.drive_laws(0.0, laws);
  set_starting_rates(mechanism, laws, start);
  std::vector<IdealState> coarse = simulate(mechanism, parameters, &laws_only, start, kFewestSteps);
  for (int steps = 2 * kFewestSteps;; steps *= 2) {
    std::vector<IdealState> fine = simulate(mechanism, parameters, &laws_only, start, steps);
    // Fourth order: the finer run's error is a fifteenth of the difference.
    const bool done = difference(coarse, fine, mechanism.characteristic_length()) < 15.0 * kAgreement;
    if (done || 2 * steps > kMostSteps) return IdealMotion(mechanism, fine);
    coarse = std::move(fine);
  }
}

}  // namespace boresight
