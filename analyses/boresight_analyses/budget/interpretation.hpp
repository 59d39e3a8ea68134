// What is to hold with a probability, of an error that varies from member to member of an ensemble and over time
// (ECSS-E-ST-60-10C, A.1.4; |e| the size of an index on one axis or of the half cone):
//
//   ensemble   over members, the largest |e| over time stays below the level
//   temporal   over time, in the worst member; `leave_out` leaves out that share of the members, the worst ones. Of the
//              worst member that there could be no number of members says anything: without `leave_out` none of those seen
//              may exceed, and that at least the share `probability` of all members does as well is shown at the confidence
//   mixed      over members and time together
//
// Members are independent of each other, the values within one are not. So intervals count members: of the ensemble
// interpretation by order statistics and Clopper and Pearson, of the mixed one by Hoeffding's bound for the members'
// shares of the time, of the temporal one by Clopper and Pearson for the share of members that keep it; where members were added
// after a first answer by what holds then (statistics/looks.hpp). A member that failed has no values and counts as bad, as in
// IndependentSamples.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "boresight_analyses/budget/member_bootstrap.hpp"
#include "boresight_analyses/statistics/interval.hpp"
#include "boresight_analyses/statistics/looks.hpp"

namespace boresight {

enum class Interpretation { ensemble, temporal, mixed };
inline constexpr Interpretation kInterpretations[] = {Interpretation::ensemble, Interpretation::temporal,
                                                      Interpretation::mixed};
const char* to_string(Interpretation interpretation);

// What a requirement asks of the members, and what one of them says, for the judgement of a look at them.
AskedShare asked_of_members(Interpretation interpretation, double probability, double confidence, double leave_out);
LookedAt looked_at_members(Interpretation interpretation, double leave_out);

class EnsembleInTime {
 public:
  // sizes[k]: |e| of member k over time, equally many of every member. Throws std::invalid_argument otherwise, or
  // without any.
  explicit EnsembleInTime(std::vector<std::vector<double>> sizes, std::int64_t failed = 0);

  // The same with all sizes of member k larger by by[k], no less than zero: what is in order stays so.
  EnsembleInTime raised(const std::vector<double>& by) const;

  std::int64_t members() const { return static_cast<std::int64_t>(maxima_.size()); }  // with values
  std::int64_t failed() const { return failed_; }

  // The level that holds with this probability.
  ReportedInterval level(Interpretation interpretation, double probability, double confidence,
                         double leave_out = 0.0) const;

  // What the level is compared with: like level(), but of the mixed interpretation by how much the members' shares of the time differ, which
  // no bound for any share is; of the worst of the members seen that one itself. Failed members are left out.
  MemberInterval about_level(Interpretation interpretation, double probability, double confidence,
                             double leave_out = 0.0) const;

  struct Compliance {
    bool met = false;
    double share = 0.0;  // of members (ensemble), of the time of the worst member counted (temporal), of both (mixed)
    double shown = 0.0;  // ensemble, mixed: at least this share, at the confidence; temporal: of the members do as well
    std::int64_t fewest = 0;  // members it takes to show it if none is ever above the limit
  };
  // The level where member k counts times[k] times, for a bootstrap over members: the least value with the share at or
  // below it. Failed members are left out.
  double resampled_level(Interpretation interpretation, double probability, double leave_out,
                         const std::vector<std::uint32_t>& times) const;
  // Whether it stays at or below the limit with this probability, one-sided; as judged, or as a first look at this confidence.
  Compliance compliance(Interpretation interpretation, double limit, double probability, const Judgement& judgement,
                        double leave_out = 0.0) const;
  Compliance compliance(Interpretation interpretation, double limit, double probability, double confidence,
                        double leave_out = 0.0) const;

 private:
  EnsembleInTime() = default;
  // Of the least value of all members together with this share of them at or below it.
  double pooled_quantile(double share) const;

  // The values of all members together, ascending, and the member of each, for bootstraps of the mixed interpretation: put in order when
  // first asked for, which takes longer than all else here.
  struct Pool {
    std::once_flag made;
    std::vector<double> values;
    std::vector<std::uint32_t> owner;
  };
  const Pool& pool() const;
  std::vector<double> quantiles_in_time(double probability) const;                     // per member
  double share_of_members_shown(std::int64_t hits, const Judgement& judgement) const;  // failed ones among the others

  std::vector<std::vector<double>> sizes_;  // each ascending
  std::vector<double> maxima_;
  std::int64_t failed_ = 0;
  std::shared_ptr<Pool> pool_ = std::make_shared<Pool>();
};

}  // namespace boresight
