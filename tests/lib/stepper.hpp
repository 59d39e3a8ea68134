// Steps a formulation by hand from any state, the contacts' memory kept as the rung keeps it.
#pragma once

#include <memory>
#include <vector>

#include "boresight/contact_events/contact_tracker.hpp"
#include "boresight/formulations/formulation.hpp"
#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/integrate/explicit_runge_kutta.hpp"

namespace boresight::scenes {

struct Stepper {
  Stepper(Formulation& f, const IdealState& start) : formulation(f), method(classical_rk4(), f.state_size()) {
    f.start(start, y);
    for (int c = 0; c < f.forces().clearances(); ++c) trackers.emplace_back(c, "joint", f.forces().joint(c), false);
    memory.resize(trackers.size());
    accept();
  }
  void accept() {
    std::array<ContactState<double>, kContactPlaces> contact;
    for (std::size_t c = 0; c < trackers.size(); ++c) {
      const int k = static_cast<int>(c);
      formulation.forces().joint(k).penetrations(formulation.forces().play_motion(k, formulation.bodies(t, y)),
                                                 contact);
      contacts += trackers[c].accept(t, contact);
      memory[c] = trackers[c].memory();
    }
  }
  void step(double h) {
    const auto derivative = [&](double time, const VecX& state, VecX& dy) {
      formulation.derivative(time, state, memory, dy);
    };
    derivative(t, y, method.first_slope());
    method.step(t, h, y, derivative);
    t += h;
    formulation.stabilise(t, y);
    accept();
  }
  Formulation& formulation;
  ExplicitRungeKutta method;
  VecX y;
  double t = 0.0;
  int contacts = 0;
  std::vector<ContactTracker> trackers;
  std::vector<ContactMemory> memory;
};

inline std::unique_ptr<Formulation> formulate(bool paper, const Mechanism& mechanism) {
  if (paper)
    return make_paper_formulation(mechanism, mechanism.parameters(), nullptr,
                                  {.stabilisation = Stabilisation::projection});
  return make_tree_formulation(mechanism, mechanism.parameters(), nullptr, {});
}

}  // namespace boresight::scenes
