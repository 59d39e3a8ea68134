#include "boresight_analyses/nonlinear/return_map.hpp"

#include <algorithm>

namespace boresight {

MatX poincare_section(const StateSeries& series, int skip) {
  const Eigen::Index first = static_cast<Eigen::Index>(skip) * series.per_period;
  const Eigen::Index points =
      series.states.cols() > first ? (series.states.cols() - 1 - first) / series.per_period + 1 : 0;
  MatX section(series.states.rows(), points);
  for (Eigen::Index k = 0; k < points; ++k) section.col(k) = series.states.col(first + k * series.per_period);
  return section;
}

int section_period(const MatX& section, const VecX& size, double share, int most) {
  for (int m = 1; m <= most; ++m) {
    if (section.cols() < 4 * m) return 0;
    const Eigen::Index pairs = section.cols() - m;
    const MatX apart = (section.rightCols(pairs) - section.leftCols(pairs)).cwiseAbs();
    if (((apart.rowwise().maxCoeff()) - share * size).maxCoeff() <= 0.0) return m;
  }
  return 0;
}

}  // namespace boresight
