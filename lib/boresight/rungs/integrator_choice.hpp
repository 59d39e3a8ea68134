// The integrators that a run may ask for by name, and what they are told about a scene.
//
//   rk4                fixed steps that do not stop at contact: impact speeds by carrying the free flight on
//                      (contact_tracker.hpp)
//   dopri5             Dormand-Prince 5(4) under error control, contacts located: for contacts that come and go
//   rosenbrock         RODAS4, L-stable, under error control, contacts located: for contacts that rest, whose
//                      vibration it steps over
//   generalized-alpha  implicit and of second order, fast modes damped; multibody only
//
// Those that locate contacts change a contact's memory at the event alone. With RunOptions::step they take fixed steps
// from event to event instead; rk4 has no error estimate, so it takes no tolerance.
#pragma once

#include <string>
#include <vector>

#include "boresight/rungs/rung.hpp"

namespace boresight {

// Of a rung; empty where it takes no steps.
std::vector<std::string> integrator_names(const std::string& rung);
// Of any rung.
std::vector<std::string> integrator_names();

// Error of one step over the smallest clearance, where RunOptions::tolerance asks for nothing.
inline constexpr double kPerturbationTolerance = 1e-3, kMultibodyTolerance = 1e-3;
double tolerance_of(const RunOptions& options, const std::string& rung);

// Of generalized-alpha at infinite frequency: fast modes lose four fifths of their amplitude in a step.
inline constexpr double kSpectralRadius = 0.2;
// A flight between contacts of the default scene [s], for whoever scales speeds against positions without a scene at hand;
// the rungs ask theirs: motion_scales.hpp.
inline constexpr double kFlightTime = 1e-3;

// The name that the options, checked by check_options(), ask for.
std::string integrator_of(const RunOptions& options);

// Whether steps follow an error estimate, each run its own: any integrator but rk4, unless a step is given.
bool controls_error(const RunOptions& options);

// Whether steps follow an error estimate, each run its own: any integrator but rk4, unless a step is given.
bool controls_error(const RunOptions& options);

// Smallest clearance that the parameters give any joint, radial or axial, leaving out those that are zero [m]; 0 if all
// are.
double smallest_clearance(const Parameters& parameters);

}  // namespace boresight
