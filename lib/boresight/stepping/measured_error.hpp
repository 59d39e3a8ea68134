// How far the indices of a run are off because time advances in steps, or is looked at in instants: measured by further runs of the same
// motion. What is said of steps here holds of the spacing of instants.
//
//   neighbours   the same rung at steps (or tolerances) 1.5 and 3 percent smaller: as good as the run itself
//   finer        the same at half the step (a hundredth of the tolerance and half the longest step it allows), with neighbours of its own;
//                in place of generalized-alpha, which damps what is fast at any tolerance, by rosenbrock
//
// Two things are told apart. Steps err: then the finer runs lie elsewhere than the run and its neighbours. And impacts
// amplify every difference until motions that began alike go their own ways: then neighbours lie as far from each other
// as from the finer runs, no step is small enough, and one run is one draw of many. With m the mean of each group, s the
// standard deviation within the groups and n runs in each,
//
//   stated = |x - m| + remainder |m - m_finer| + t s sqrt(1 + 1/n)
//
// covers, with a confidence of 95 percent, what a run at a finer step would differ by; t is Student's. remainder: what
// the finer group still lacks, for an error that falls at least with the first power of the step: 2 where the shift
// stands out of the scatter, 1 where it cannot be told from it. Of a maximum no less is stated than what any part of the motion may reach.
//
//   const MeasuredError error = measure_discretisation(*rung, parameters, options, result);
//   if (error.measured) error.stated.position_error.max;     // [m]
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "boresight/rungs/rung.hpp"

namespace boresight {

struct MeasuredError {
  bool measured = false;
  std::string why_not;     // where not measured
  PointingIndices stated;  // by how much each index may be off, in its own unit [m, rad]
  PointingIndices spread;  // standard deviation of an index among neighbours [m, rad]
  PointingIndices shift;   // |mean of the finer runs - mean of the neighbours| [m, rad]
  // Likewise of what is printed beside the indices; 0 where not measured.
  std::vector<double> contact_force;  // per clearance, of the largest force of one contact [N]
  Vec3 acceleration = Vec3::Zero();   // of the boresight body's largest [m/s^2]
  int runs = 0;                       // besides the one that was measured
  bool by_instants = false;           // of a rung that takes no steps
  double cpu_seconds = 0.0;
  std::string basis;  // in words

  // Whether an index scatters among neighbours more than steps move it: what is stated is then how far one motion is from
  // another, not an error that smaller steps would mend.
  bool scatters(Statistics PointingIndices::*quantity, double Statistics::*statistic) const {
    const double s = spread.*quantity.*statistic;
    return s > 0.0 && shift.*quantity.*statistic < 2.0 * s;
  }
};

struct MeasureErrorOptions {
  double most_seconds = 10.0;          // of CPU for all further runs, as foreseen from the first; 0: any
  std::function<bool()> advance = {};  // asked now and then; return false to stop: then it is not measured
};

// result: of this rung with these parameters and options. Does not throw for a motion that cannot be followed at a
// neighbouring step: the error is then not measured, and it says why.
MeasuredError measure_discretisation(const Rung& rung, const Parameters& parameters, const RunOptions& options,
                                     const RunResult& result, const MeasureErrorOptions& measure = {});

}  // namespace boresight
