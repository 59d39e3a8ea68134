// How far a standard deviation can be trusted when the values are not normal.
#pragma once

#include <vector>

namespace boresight {

// Interval of ln(sd / estimated sd).
struct LogSdInterval {
  double low = 0.0, high = 0.0;
};

// Bonett (2006), Computational Statistics & Data Analysis 50, Eq. 3: normal on the logarithm, with an estimate of the
// kurtosis about the trimmed mean. `sorted` ascending, at least five values.
LogSdInterval bonett_interval(const std::vector<double>& sorted, double confidence);

}  // namespace boresight
