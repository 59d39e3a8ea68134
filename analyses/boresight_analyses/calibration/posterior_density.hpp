// What a calibration's parameters may be, given its data, as a density for a sampler.
//
// What needs a motion is sampled: the fitted parameters in the coordinates of the fit, the clock's offset, the sensor's lag. All else is
// integrated out, so that no motion is followed for it:
//
//   f(r(theta)) + F b + D c + B w = noise     b: offsets and drifts of channels, any as probable; c: suspects, N(0, 1);
//                                             w: jumps that nobody has named, N(0, q^2 s^2), any q as probable; noise N(0, s^2), any log s
//
//   -2 log p(theta | q) = (log det V + log det F' V^-1 F + (N - F) log RSS(q, theta)) / D + prior(theta),   V = 1 + q^2 B B'
//
// (Zellner 1971, An introduction to Bayesian inference in econometrics, section 3.1, for b and s), summed over q; with suspects also over s
// (noise_scales.hpp). Priors are a term of their own, since they are known in their own units: in RSS, one that the data contradict would
// count as noise, and make what it says nothing of uncertain too. F, B and D are those at the fit. f is the residual as the loss has it there, and straight from there on,
//
//   f(r) = f(r_fit) + f'(r_fit) (r - r_fit):
//
// what stands out of the fit counts less wherever theta goes, and no more than that does. Were the loss taken anew at each theta, it would
// flatten the noise wherever the motion is far off, and b, c and w take the rest: the farther off, the more probable. D, Birge's ratio
// squared, flattens what runs contradict each other by. Priors: those of the study; without one, any coordinate between the bounds is as
// probable as any other.
//
// A suspect moves the motion as parameters do, and by more than a straight line follows: what parameters can mimic of it, D = A S + rest
// with A = dr / d theta, is taken as a shift of these,
//
//   r(theta) + D c = r(theta + S c) + rest c
//
// so that it is theta + S c that is sampled. Then c is drawn given that, and its shift taken off again: drawn().
//
// The motions are the fit's own rung's, with what multibody had beside them at the optimum added. Runs start from rest: start states that
// are free would have to be sampled too.
#pragma once

#include <functional>
#include <vector>

#include "boresight_analyses/calibration/calibration_fit.hpp"
#include "boresight_analyses/calibration/model_error.hpp"
#include "boresight_analyses/calibration/reduced_window.hpp"

namespace boresight {

class PosteriorDensity {
 public:
  // problem: as the fit left it; a copy is kept. All windows from rest. fixed: parameters that are held, not all. variance_factor:
  // Inference's.
  PosteriorDensity(const CalibrationProblem& problem, const FitResult& fit, const std::vector<bool>& fixed,
                   const std::vector<Suspect>& suspects, double variance_factor, double disagreement, int jobs);

  // Columns of the problem's globals that are sampled.
  const std::vector<int>& sampled() const { return sampled_; }
  int size() const { return static_cast<int>(sampled_.size()); }

  // At y, the sampled globals shifted by S c; -infinity beyond a bound and where no motion could be followed. A gradient of size 0 is not
  // asked for.
  double log_density(const VecX& y, VecX& gradient) const;
  // The sampled globals themselves. uniform, normal(k): random numbers.
  VecX drawn(const VecX& y, double uniform, const std::function<double(int)>& normal) const;

  // What the density would be were the motion linear in y: its mean and its covariance.
  const VecX& mean() const { return mean_; }
  const MatX& covariance() const { return covariance_; }
  // Of a sampled global; infinite where there is none.
  double lower(int k) const { return lower_[k]; }
  double upper(int k) const { return upper_[k]; }

 private:
  struct PlacedWindow {
    int window = 0;
    VecX state;
    VecX r_fit, f_fit, slope;  // f' there
    MatX X;                    // F, then the suspects' rests
    ReducedWindow reduced;
    VecX f(const VecX& r) const { return f_fit + slope.cwiseProduct(r - r_fit); }
  };
  struct Size {                    // of a jump
    double q = 0.0, weight = 0.0;  // weight: the logarithm of what does not hang on y
    MatX flat_inverse, flat_by_c;  // of F' V^-1 F; F' V^-1 times the suspects' rests
    MatX basis;                    // of c, in which its prior is 1 and the data's matrix diagonal
    VecX lambda;
  };
  struct Scale {  // of the noise, for one size of the jumps
    std::size_t size = 0;
    double square = 1.0, share = 0.0;  // s^2 D; its probability
    VecX c;                            // in the basis
  };
  // Of one y. pull, pulled: by size of the jumps, sums of share / square, and of that times (b, c).
  struct Weighed {
    std::vector<VecX> r;
    std::vector<MatX> J;
    std::vector<ReducedWindow> reduced;
    std::vector<Scale> scales;
    std::vector<double> pull;
    std::vector<VecX> pulled;
    VecX c;  // its mean
    double log_density = 0.0;
  };
  bool weigh(const VecX& y, bool slopes, Weighed& out) const;
  void set_sizes(const std::vector<ReducedWindow>& full, long values);

  CalibrationProblem problem_;
  Globals fitted_;
  std::vector<int> sampled_;
  VecX lower_, upper_, known_, told_;  // known: what was known before, one over its variance, about `told`
  std::vector<PlacedWindow> windows_;
  std::vector<Size> sizes_;
  MatX mimics_;  // S
  VecX mean_;
  MatX covariance_;
  Eigen::Index flat_ = 0, suspects_ = 0;
  double freedoms_ = 0.0;         // N - F
  double flattened_ = 1.0;        // D
  double variance_factor_ = 1.0;  // of the fit
  bool noise_known_ = false;      // the data leave nothing to tell it by: the fit's
};

}  // namespace boresight
