// Several parameters drawn together as a row of a table of samples, each row as probable as any other: what a posterior by draws, or a
// list of measured specimens, says of them, however they hang together.
//
// Each of the parameters has a column of the table as its distribution; all columns of one table take their values from one row, which
// the first parameter's coordinate of the unit cube picks. Rows stand in the order of what their columns have in common, so that designs
// which spread that coordinate evenly (lhs, sobol) spread them too: by their projection on the first principal axis of the ranks
// (Jolliffe 2002, Principal Component Analysis, section 3.3), ties as they stand.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "boresight/math/types.hpp"
#include "boresight_analyses/random/distribution.hpp"

namespace boresight {

class SampleRows {
 public:
  // rows: samples x parameters, SI; at least one.
  explicit SampleRows(const MatX& rows);

  Eigen::Index size() const { return rows_.rows(); }
  Eigen::Index columns() const { return rows_.cols(); }
  double at(Eigen::Index row, Eigen::Index column) const { return rows_(row, column); }
  // "rows(2000 of 4, 53fb...)": equal texts are equal rows.
  std::string text() const;
  // The row that u in (0, 1) picks.
  Eigen::Index row_of(double u) const;

 private:
  MatX rows_;  // in their order
};

// How parameter k = 0, 1, .. of the table scatters by itself.
DistributionPtr column_of(std::shared_ptr<const SampleRows> rows, Eigen::Index k);

// The table whose first column a distribution is; null: of none.
const SampleRows* rows_from(const DistributionPtr& distribution);
// The table that it is any column of.
const SampleRows* rows_with(const DistributionPtr& distribution);

}  // namespace boresight
