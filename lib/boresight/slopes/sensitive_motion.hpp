// The perturbation rung's motion with its derivatives by start state and parameters, carried forward through
// impacts.
//
// With y = (z, zdot), m the latched impact speeds and q the quantities varied (parameters, start state):
//
//   y' = f(t, y, m, q)        S = dy/dq:  S' = f_y S + f_m dm/dq + f_q
//
// The right side of S' is what f gives for jets whose derivatives are (S, dm/dq, dq/dq): offset_dynamics.hpp
// once more.
//
// At an event g(t*, y, q) = 0 (g: penetration) the field changes from f- to f+ and S jumps (Aizerman and
// Gantmacher 1958, Quarterly Journal of Mechanics and Applied Mathematics 11, 163-178; saltation matrix):
//
//   S+ = S- + (f- - f+) dt*/dq,        dt*/dq = -(g_y S + g_q) / (g_t + g_y f)
//
// Where forces start from zero at d = 0 (all laws without a dashpot, and what friction makes of them), f+ =
// f- at every closing and opening, the jump in S is zero, and what is left of the impact's sensitivity is in
// the memory. The latched speed is the gap's rate r(t, y, q) at the event:
//
//   dm/dq = r_y S + r_q + (r_t + r_y f) dt*/dq        the least impact speed's own where that takes its place
//
// Where contact only grazes, g_t + g_y f -> 0 and dt*/dq grows without bound: derivatives there hold for ever
// smaller changes of q only. Such impacts are counted.
//
// Explicit steps stand at the limit of stability where a journal lies in a damped contact; S, which has no say in them, then grows without
// bound unless derivative_tolerance keeps it small. Implicit ones do not, and cost less there: shifted_sensitivities.hpp.
//
// Steps are chosen by the error of y alone, as if S were not there, unless derivative_tolerance asks for
// more: the derivatives are then those of the numerical motion with its steps held fixed (internal
// differentiation; Bock 1981), and y is the same with and without them. Inside an impact S is some thousand
// times what it is before and after, so what is left of it behind the impact is less exact than y by about
// that factor.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "boresight/scene/clearance_scene.hpp"
#include "boresight/scene/scene_rung.hpp"
#include "boresight/slopes/contact_number_slopes.hpp"
#include "boresight/slopes/tables_beside.hpp"

namespace boresight {

struct Grazing {
  double t = 0.0;  // [s]
  int clearance = 0;
  double speed = 0.0;  // of approach [m/s]
};

// What one stretch of motion gives.
struct SensitiveMotion {
  MatX state;                        // 2n x times
  std::vector<MatX> by;              // per time: 2n x directions; empty without directions
  std::vector<double> impact_speed;  // of the contacts begun inside, above the least speed [m/s]
  std::vector<int> impact_joint;     // their clearances
  std::vector<Grazing> grazing;
  long steps = 0;
};

struct MotionRequest {
  double start = 0.0, end = 0.0;      // [s]
  VecX start_state;                   // 2n
  MatX start_by_parameters;           // 2n x parameters: how it follows them; empty: not at all
  std::vector<TablesBeside> beside;   // of the parameters that the tables hang on
  std::vector<double> times;          // within [start, end], rising [s]
  bool by_parameters = false;         // directions 0 .. parameters-1
  bool by_start_state = false;        // the next 2n directions
  double tolerance = 1e-3;            // of a step, over the smallest clearance
  double derivative_tolerance = 0.0;  // of S times each quantity's own size, as tolerance; 0: S has no say in the steps
  double grazing_speed = 0.0;         // approaches slower than this graze; 0: twice the least impact speed [m/s]
  double longest_step = std::numeric_limits<double>::infinity();  // of a step: longest_step_of() its scene [s]
  long most_steps = 0;                                            // attempts of steps; 0: any that one run may take
  // Steps that no stiff or damped contact keeps short (RODAS4), each as dear as some of the explicit ones: implicit_steps_pay().
  bool implicit = false;
  std::function<void(double)> reached =
      {};  // told the time at the end of every step [s]; what it throws ends the motion
};

// As the perturbation rung's own: no turn of the mechanism and no change of a load is stepped over.
double longest_step_of(const PreparedScene& scene);

// parameters: the mechanism's at this point, for clearances and least impact speeds.
// Throws ComputationError where the motion cannot be followed.
SensitiveMotion follow_with_sensitivity(const Mechanism& mechanism, const Parameters& parameters,
                                        const std::shared_ptr<const SceneTables>& tables, const ContactNumbers& numbers,
                                        const MotionRequest& request);

// Whether the motion, followed without directions by either kind of steps, asks for less work by implicit ones; not where these cannot follow
// it. Where journals lie in their contacts damping keeps explicit steps short, to a hundredth and less of what the motion needs.
bool implicit_steps_pay(const Mechanism& mechanism, const Parameters& parameters,
                        const std::shared_ptr<const SceneTables>& tables, const ContactNumbers& numbers,
                        const MotionRequest& request);

}  // namespace boresight
