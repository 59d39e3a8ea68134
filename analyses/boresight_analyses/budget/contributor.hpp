// An error that comes from outside of the mechanism's clearances, given by its class (ECSS-E-ST-60-10C, Annex B):
//
//   bias      one value B for a member, all the time
//   random    noise of zero mean and standard deviation s, first order with a correlation time
//   periodic  a sinusoid of amplitude A and some period, its phase unknown
//   drift     D t, from the beginning of the motion, whenever the history begins; recalibrated, of each observation
//
// or by its spectrum (noise.hpp), a stationary noise times a factor F; as it was measured over time (measured_course.hpp), times such a
// factor; or a standing error of the mechanism over time (error_course.hpp). These have no class of ECSS'.
//
// `through` is the transfer function between it and the pointing, of which classes see what is left once it has settled: a bias H(0), a
// sinusoid |H| and its lead, a drift D the course D (H(0) t + H'(0)), noise its spectrum.
//
// B, s, A, D, F are the ensemble parameter: per axis, with a distribution over members. Two faces of one contributor: its
// moments, for the classical table, and its course in time in one member, for the simulated one.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "boresight_analyses/budget/draws.hpp"
#include "boresight_analyses/budget/error_course.hpp"
#include "boresight_analyses/budget/interpretation.hpp"
#include "boresight_analyses/budget/measured_course.hpp"
#include "boresight_analyses/budget/noise_course.hpp"
#include "boresight_analyses/budget/window_filter.hpp"
#include "boresight_analyses/random/distribution.hpp"

namespace boresight {

enum class ContributorClass { bias, random, periodic, drift, spectrum, measured };
const char* to_string(ContributorClass kind);

struct Contributor {
  std::string name;
  ContributorClass kind = ContributorClass::bias;
  std::array<DistributionPtr, 3> parameter =
      {};               // of the ensemble, per axis; none where it does not act [SI; drift: per s; a factor: 1]
  double period = 0.0;  // periodic [s]
  double correlation_time = 0.0;  // random [s]
  bool recalibrated = false;      // with every observation a bias is another one, and a drift begins at zero
  std::optional<TransferFunction> through = {};          // bias, periodic, drift; others have it in what follows
  NoisePtr noise = {};                                   // spectrum; random with `through`, of deviation 1
  std::shared_ptr<const NoiseCourse> noise_course = {};  // the same on the grid of the histories
  std::shared_ptr<const MeasuredCourse> measured = {};   // measured
  // Its own axes in those of the error, as columns, and the factor of the correlation between them (draws.hpp).
  Mat3 frame = Mat3::Identity(), axes_factor = Mat3::Identity();
  std::string group = {};                    // contributors of one group vary together; "": by itself
  std::optional<ErrorCourse> of_error = {};  // in place of all but name and group
};

// Mean and standard deviation to enter in the budget of one index, by interpretation (ECSS-E-ST-60-10C, Tables B-1 to
// B-7), with the filters of window_filter.hpp where the standard only tells short from long periods:
//   ensemble   of the largest size over time; of noise three times its deviation
//   temporal   over time, with the worst case of the ensemble parameter: the end of its distribution, or three deviations
//   mixed      over both; the variance of the conditional mean is part of it (law of total variance), which the
//              standard's integral leaves out
// Of a spectrum the filters of the windows are integrated over it; of a measured course its index values count. `duration`: of the histories [s].
// `axis`: of its own.
Moments moments(const Contributor& contributor, int axis, ErrorIndex index, Interpretation interpretation,
                const Windows& windows, double duration);

// Of all axes together: the means, and B with B B^T their covariance, in the axes of the error. Where means are largest sizes, as of what
// changes in the ensemble interpretation, or worst cases of what scatters, they may come with either sign: those of turned axes add up, and
// nothing cancels them.
struct AxesMoments {
  Vec3 mean = Vec3::Zero();
  Mat3 factor = Mat3::Zero();
  bool either_sign = false;
};
AxesMoments axes_moments(const Contributor& contributor, ErrorIndex index, Interpretation interpretation,
                         const Windows& windows, double duration);

// Its course in one member: a function of (seed, member) alone, in the axes of the error. `draws`: contributors of one group share them, and with
// them what they draw. Throws std::invalid_argument where noise or a measured course was made for another grid.
std::vector<Vec3> course(const Contributor& contributor, std::uint64_t seed, std::uint64_t member, const Draws& draws,
                         double spacing, std::size_t samples, const Windows& windows);
// Stream of each contributor: its place, or that of the first one of its group.
std::vector<std::uint64_t> streams_of(const std::vector<Contributor>& contributors);
std::vector<Draws> draws_of(const std::vector<Contributor>& contributors,
                            const std::vector<ContributorCorrelation>& correlations = {});

}  // namespace boresight
