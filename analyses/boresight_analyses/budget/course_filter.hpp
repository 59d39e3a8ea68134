// A course in time through a transfer function: exact for a course that is straight between its instants.
//
// The function in its controllable form x' = A x + B u, y = C x + D u, over one step as an exponential of the matrix
// [A B 0; 0 0 I; 0 0 0] (Van Loan 1978, IEEE Trans. Automatic Control 23, 395; "first-order hold" in Franklin, Powell, Workman 1998,
// Digital Control of Dynamic Systems, 6.3.2).
#pragma once

#include <Eigen/Core>
#include <vector>

#include "boresight_analyses/budget/transfer_function.hpp"

namespace boresight {

class CourseFilter {
 public:
  // Of a stable function, for instants `step` apart [s].
  CourseFilter(const TransferFunction& function, double step);

  // What comes out at the same instants, once it has settled at the first value.
  std::vector<double> through(const std::vector<double>& course) const;

  // After which a transient is below a millionth [s]; 0 of a function without poles.
  static double settling_time(const TransferFunction& function);

 private:
  Eigen::MatrixXd from_state_;                // over a step
  Eigen::VectorXd from_value_, from_change_;  // and what the value at its beginning and its change in it add
  Eigen::VectorXd settled_;                   // state, for a value of 1
  Eigen::RowVectorXd output_;
  double direct_ = 0.0;
};

}  // namespace boresight
