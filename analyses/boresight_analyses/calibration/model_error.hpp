// What a calibration knows where its model is not the rig.
//
// Impacts amplify what goes before them: late readings follow the parameters steeply, and as steeply all that a model leaves out. Least squares
// takes them for exact and believes them; its errors by curvature are then those of a model without fault. Here the model may err in two ways.
//
//   suspects   numbers that the fit takes as known, c_k standard deviations off what it was told (an axial gap, a mass, a lag of the sensor)
//   jumps      what nobody has named: a step of the state now and then on the way, of size q in scales of the state
//              (weak-constraint estimation: Tremolet 2006, Quarterly Journal of the Royal Meteorological Society 132, 2483-2504)
//
//   r(u + du) = r + A du + D c + B w + noise      c ~ N(0, 1), w ~ N(0, q^2), noise ~ N(0, s^2)
//
// With V = 1 + q^2 B B' the rest is generalised least squares for (du, c); readings beyond the horizon of predictability count as little as
// they deserve, and a parameter that a suspect mimics is known as well as the suspect. q is what the data say of it: its restricted likelihood
// (Patterson and Thompson 1971, Biometrika 58, 545-554),
//
//   -2 log L(q) = log det V + log det X' V^-1 X + (N - k) log RSS(q)
//
// with all q equally likely before (Gelman 2006, Bayesian Analysis 1, 515-534), and the answer is the mean over q, its covariance that of the
// mixture. What runs contradict each other by beyond that widens the errors by Birge's ratio (Birge 1932, Physical Review 40, 207-227).
#pragma once

#include <string>
#include <vector>

#include "boresight_analyses/calibration/inference.hpp"

namespace boresight {

// Something that the fit takes as known.
struct Suspect {
  std::string name;          // "clearance.D.axial"
  std::string says;          // what would explain the data: "an axial gap of D ..."
  double deviation = 0.0;    // how well it is known, one standard deviation
  std::string unit;          // of it: "%" of what was told, counted as a share; or SI
  std::vector<VecX> change;  // per fitted window: of its standardised residuals, by one standard deviation
  // Where it is nothing but another value of a fitted parameter: which one (else -1), and by how much of its coordinate.
  int as_parameter = -1;
  double coordinate = 0.0;
};

// Twice the logarithm of a likelihood ratio that decides, as between contact laws.
inline constexpr double kDecides = 10.0;

struct SuspectFound {
  std::string name, says;
  double deviation = 0.0;  // Suspect's, and its unit
  std::string unit;
  double mean = 0.0, error = 1.0;  // of c
  double gain = 0.0;               // by how much it alone lowers the loss, over s^2: from 10 on it explains something
  VecX adds;                       // to the standard error of every parameter's coordinate
};

struct CalibrationModelError {
  VecX shift;              // of the globals, from where the fit ended
  MatX covariance;         // of the globals; NaN where held
  double jump = 0.0;       // q, its mean
  double jump_gain = 0.0;  // 2 log of the likelihood ratio of its most likely value to none
  std::vector<SuspectFound> suspects;
  int optima = 1;             // how many weigh more than a hundredth of all
  double disagreement = 1.0;  // Birge's ratio of the groups, as a standard deviation
  int groups = 0;             // runs, or windows where they start freely
  int ends = 0;               // of the search's paths, each beyond the errors of the fit, that the errors span

  // Beyond what noise does.
  bool contradicted() const { return groups > 1 && disagreement > 1.5; }
  // Whether stretches of a run contradict each other: the data ask for jumps on the way.
  bool departs() const { return jump_gain > kDecides; }
};

// The fit's windows with what the suspects change. optima: other places where fits have ended; those that such a model may as well have
// made the data at are weighed in by their likelihood. fixed: parameters that are held.
CalibrationModelError model_error(const CalibrationProblem& problem, const FitResult& fit,
                                  const std::vector<Suspect>& suspects, const std::vector<Globals>& optima,
                                  const std::vector<bool>& fixed, double variance_factor, int jobs);

// Where runs contradict each other in the lowest valley that was found, it need not be the truth's: what the ends of further paths of the
// search are away from it is as likely its own distance, and widens the errors. ends: with its own.
void span(const std::vector<Globals>& ends, const CalibrationProblem& problem, const Globals& fitted,
          CalibrationModelError& error);

// Moves the estimates and widens their errors and intervals, profiles' included; nothing becomes narrower.
void take_model_error(const CalibrationModelError& error, double confidence, const CalibrationProblem& problem,
                      const Globals& fitted, Inference& inference);

// What it means, one sentence each: whether runs and stretches contradict each other, what would explain it, and what an error comes from.
std::vector<std::string> in_words(const CalibrationModelError& error, const CalibrationProblem& problem,
                                  const Inference& inference);

}  // namespace boresight
