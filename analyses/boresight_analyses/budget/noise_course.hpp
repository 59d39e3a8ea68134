// A noise over time, drawn from its spectrum: sums of sinusoids with Gaussian amplitudes (Rice 1944, Mathematical Analysis of Random Noise,
// eq. 1.7-2), whose mean squares are the power in their bands.
//
// The grid of frequencies has a period of several histories, so that a history's end knows nothing of its beginning. Bands of that grid are
// too wide where the power lies far below one over a history (flicker, slow loops): there narrower ones take their place, each at its root
// mean square frequency, and below all of them one constant. Samples stand for instants: what lies above half the sampling's frequency is
// folded down onto them (Bendat and Piersol 2010, 10.3.2), so that their variance is the whole one. What a window's mean keeps of that share
// is then not what it would; power_above_sampling() says how large the share is.
#pragma once

#include <complex>
#include <cstddef>
#include <functional>
#include <vector>

#include "boresight_analyses/budget/noise.hpp"

namespace boresight {

class NoiseCourse {
 public:
  // samples at times `spacing` apart [s].
  NoiseCourse(const Noise& noise, double spacing, std::size_t samples);

  // One history [unit]. normal(k): of sinusoid k, two independent standard normal numbers as one complex. On one grid sinusoid k of any
  // noise has the same band, so that those that are given the same numbers are fully coherent.
  using Normals = std::function<std::complex<double>(std::uint64_t)>;
  std::vector<double> drawn(const Normals& normal) const;

  std::size_t samples() const { return samples_; }
  double spacing() const { return spacing_; }
  double variance() const;                                         // of its samples
  double power_above_sampling() const { return above_sampling_; }  // share of the variance

 private:
  struct Slow {
    double frequency, deviation;
  };

  double spacing_;
  std::size_t samples_;
  std::vector<Slow> slow_;         // the first one constant
  std::vector<double> deviation_;  // of the grid's sinusoids, k = 0 .. period / 2
  double above_sampling_ = 0.0;
};

}  // namespace boresight
