// What a motion must keep: momentum where nothing holds the mechanism, energy where nothing drives or loads it.
#include <algorithm>
#include <cmath>

#include "boresight/formulations/formulation.hpp"
#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/integrate/explicit_runge_kutta.hpp"
#include "boresight/ladder/ladder.hpp"
#include "measure.hpp"

namespace boresight::gauntlet {

Json momentum_change(const std::shared_ptr<const Mechanism>& mechanism, const Asked& asked) {
  const MechanismDescription& m = mechanism->description();
  RunOptions options;
  options.step = asked.step;
  options.integrator = asked.integrator;
  options.formulation = asked.formulation;
  options.sample_spacing = mechanism->duration() / 20.0;
  for (int b = 0; b < mechanism->bodies(); ++b)
    if (b != mechanism->boresight_body()) options.pose_bodies.push_back(b);
  const RunResult r = make_rung(asked.rung, mechanism)->run(mechanism->parameters(), options);
  std::vector<const BodyHistory*> bodies = {&r.boresight};
  for (const BodyHistory& h : r.others) bodies.push_back(&h);
  const std::vector<MassProperties> masses = mechanism->mass_properties(mechanism->parameters());
  Vec6 first = Vec6::Zero();
  Vec6 scale = Vec6::Zero();
  Vec6 change = Vec6::Zero();
  for (std::size_t k = 0; k < r.time.size(); ++k) {
    Vec6 momentum = Vec6::Zero();
    for (const BodyHistory* h : bodies) {
      const PoseSample& s = h->samples[k];
      const MassProperties& body = masses[h->body];
      const Mat3 R = s.pose.q.toRotationMatrix();
      const Vec3 c = R * body.c, v = s.v + s.w.cross(c), place = s.pose.p + c - m.bodies[0].center_of_mass;
      const Vec3 p = body.mass * v, spin = R * body.inertia * R.transpose() * s.w;
      momentum.head<3>() += p;
      momentum.tail<3>() += place.cross(p) + spin;
      scale.head<3>() = scale.head<3>().cwiseMax(p.norm());
      scale.tail<3>() = scale.tail<3>().cwiseMax(spin.norm() + place.norm() * p.norm());
    }
    if (k == 0) first = momentum;
    change = change.cwiseMax((momentum - first).cwiseAbs());
  }
  // Against the largest part of the whole motion: before the first impact nothing may move but rounding.
  // Turning and moving on the mechanism's size: where nothing strikes, bodies may turn in place and their momentum be rounding.
  const double length = mechanism->characteristic_length();
  scale.head<3>() = scale.head<3>().cwiseMax(scale.tail<3>() / length);
  scale.tail<3>() = scale.tail<3>().cwiseMax(scale.head<3>() * length);
  const double worst = scale.minCoeff() > 0.0 ? change.cwiseQuotient(scale).norm() : 0.0;
  return {{"change", std::isfinite(worst) ? worst : 1e300},
          {"step", mechanism->duration() / static_cast<double>(std::max<std::int64_t>(1, r.cost.steps))}};
}

Json energy_change(const std::shared_ptr<const Mechanism>& mechanism, int steps) {
  Json out = Json::object();
  const IdealMotion ideal = ideal_motion(*mechanism, mechanism->parameters());
  IdealState start;
  ideal.state(0.0, start);
  for (const char* name : {"tree", "paper"}) {
    const std::unique_ptr<Formulation> f =
        std::string(name) == "tree"
            ? make_tree_formulation(*mechanism, mechanism->parameters(), &ideal, {.with_clearance = false})
            : make_paper_formulation(*mechanism, mechanism->parameters(), &ideal, {.with_clearance = false});
    const std::vector<ContactMemory> none;
    VecX y;
    f->start(start, y);
    ExplicitRungeKutta method(classical_rk4(), y.size());
    const auto derivative = [&](double t, const VecX& state, VecX& dy) { f->derivative(t, state, none, dy); };
    const double h = mechanism->duration() / steps, before = f->energy(0.0, y);
    double lowest = before, highest = before, rise = 0.0;
    // The scale: kinetic energy, and how far the potential goes up and down.
    double kinetic = 0.0;
    const auto kinetic_of = [&](double t) {
      const std::vector<MassProperties> masses = mechanism->mass_properties(mechanism->parameters());
      const std::vector<BodyMotion>& bodies = f->bodies(t, y);
      double sum = 0.0;
      for (std::size_t b = 0; b < bodies.size(); ++b) {
        const Vec3 v = bodies[b].v + bodies[b].w.cross(bodies[b].R * masses[b].c),
                   w = bodies[b].R.transpose() * bodies[b].w;
        sum += 0.5 * masses[b].mass * v.squaredNorm() + 0.5 * w.dot(masses[b].inertia * w);
      }
      return sum;
    };
    for (int i = 0; i < steps; ++i) {
      kinetic = std::max(kinetic, kinetic_of(i * h));
      derivative(i * h, y, method.first_slope());
      method.step(i * h, h, y, derivative);
      f->stabilise((i + 1) * h, y);
      const double energy = f->energy((i + 1) * h, y);
      rise = std::max(rise, energy - lowest);
      lowest = std::min(lowest, energy);
      highest = std::max(highest, energy);
    }
    const double scale = std::max(kinetic, 1e-300);
    out[name] = {{"change", (highest - lowest) / scale}, {"rise", rise / scale}};
  }
  return out;
}

}  // namespace boresight::gauntlet
