// The power spectral density of pointing histories, by periodograms averaged over the members (Welch 1967, IEEE Trans. Audio
// Electroacoustics 15, eqs. 2 to 4, one segment a member, with a Hann window).
#pragma once

#include <vector>

#include "boresight_analyses/budget/error_index.hpp"

namespace boresight {

struct ErrorSpectrum {
  std::vector<double> frequency;  // ascending [Hz]
  std::vector<double> density;    // one-sided, of the axes together [unit^2/Hz]
};

// Without each history's mean on each axis. Frequencies are those of the histories' length, joined to at most `per_decade` in a decade by
// their mean. `histories`: of one length and spacing, at least four samples; none give an empty spectrum.
ErrorSpectrum spectrum_of(const std::vector<PointingHistory>& histories, double per_decade = 40.0);

}  // namespace boresight
