// What a cubic through evenly spaced values gives halfway between two of them: what a grid misses there says how fine it has to be.
#pragma once

#include <algorithm>
#include <vector>

namespace boresight {

// The cubic through the four knots around cell k, one-sided at the ends, at a fraction of the cell; of matrices or vectors of one size. At
// least four knots.
template <typename Values>
Values cubic_at(const std::vector<Values>& knots, int k, double fraction) {
  const int first = std::clamp(k - 1, 0, static_cast<int>(knots.size()) - 4);
  Values cubic = Values::Zero(knots[0].rows(), knots[0].cols());
  for (int i = 0; i < 4; ++i) {
    double weight = 1.0;
    for (int j = 0; j < 4; ++j)
      if (j != i) weight *= (k + fraction - (first + j)) / static_cast<double>(i - j);
    cubic += weight * knots[static_cast<std::size_t>(first + i)];
  }
  return cubic;
}

template <typename Values>
Values cubic_at_middle(const std::vector<Values>& knots, int k) {
  return cubic_at(knots, k, 0.5);
}

}  // namespace boresight
