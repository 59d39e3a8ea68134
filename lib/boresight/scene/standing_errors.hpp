// What standing errors displace the bodies by over time, to first order: G(t) eps, beside the deviation E(t) z of the play.
//
// G are the columns of ErrorInfluence as functions of time; they hang on the drawn mechanism and its commanded motion alone, and all samples
// share them. What the errors change of the dynamics (masses elsewhere, other gaps) is of second order.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "boresight/math/time_table.hpp"
#include "boresight/mechanism/error_influence.hpp"

namespace boresight {

class StandingErrors {
 public:
  // wanted: of which errors; the others count as zero. The grid is refined until its cubics meet the columns to kAccuracy of the largest
  // value of each. Throws ComputationError as ErrorInfluence::at does, and naming the error that no grid holds; MotionTooDense where
  // a table of the motion would need too much memory whatever its errors do.
  StandingErrors(const Mechanism& mechanism, const IdealMotion& commanded, std::vector<bool> wanted);
  static constexpr double kAccuracy = 1e-7;
  static constexpr int kFewestInstants = 1000;

  // Of all errors that the mechanism takes up: what samples of any errors share, the same whichever comes first.
  static std::shared_ptr<const StandingErrors> of_all(const Mechanism& mechanism, const IdealMotion& commanded);

  int count() const { return static_cast<int>(wanted_.size()); }
  // Throws ComputationError where an error that is not zero is none of those wanted, and says what of_all() found wrong with it.
  void require(const std::vector<double>& errors) const;
  // Of one body: 6 x errors, row by row, over time; and its rate of change. Safe to share between threads.
  const TimeTable& gain(int body) const;
  const TimeTable& gain_rate(int body) const;
  // Whether redundant joints with play may take up errors; then what the offsets that follow from others are shifted by: OffsetLayout x
  // errors, row by row, over time.
  bool shifts() const { return shifts_; }
  const TimeTable& shift() const { return shift_; }
  // Whether that is so of one error: then its gain alone does not tell what it does, for that hangs on where all journals rest.
  bool uses_play(std::size_t error) const;
  int cells() const { return static_cast<int>(knots_.size()) - 1; }
  // Of one body at knot k: 6 x errors.
  Eigen::Block<const MatX> at_knot(int k, int body) const {
    return knots_[static_cast<std::size_t>(k)].block(6 * body, 0, 6, count());
  }
  double spacing() const { return spacing_; }
  // Instants a cell at which statistics over time are taken where errors alone deviate: what lies between them is some 1e-4 of a
  // maximum at most, as a cell is 0.08 of a radian of what is fastest in the columns.
  int instants_a_cell() const { return std::max(2, (kFewestInstants + cells() - 1) / cells()); }

 private:
  // By how much the knots' cubics miss a column at most, of its largest, and where.
  struct Miss {
    double share = 0.0, t = 0.0;
    std::size_t error = 0;
    void add(double share_there, std::size_t of_error, double at) {
      if (share_there > share) *this = {share_there, at, of_error};
    }
  };
  // At places that are no fractions of the motion.
  Miss missed_elsewhere(const std::function<MatX(double)>& at, const VecX& scale,
                        const Eigen::RowVectorXd& largest) const;
  // Says why no grid holds a column, which the one of this spacing misses: its law, or else what is given.
  [[noreturn]] static void refuse_column(const Mechanism& mechanism, const IdealMotion& commanded, const Miss& miss,
                                         double spacing, const char* unless_by_law);
  void table_shifts(ErrorInfluence& influence);
  const TimeTable& kept(std::map<int, TimeTable>& tables, int body, bool rate) const;

  int bodies_;
  std::vector<bool> wanted_;
  std::vector<std::string> refusal_;  // per error; empty: none was asked for
  double spacing_ = 0.0;
  std::vector<MatX> knots_;  // 6 bodies x errors
  bool shifts_ = false;
  TimeTable shift_;
  mutable std::mutex mutex_;
  mutable std::map<int, TimeTable> gain_, gain_rate_;
};

// One sample's errors: what they displace a body by, with its rates of change, world axes [m, rad]. Serves one thread.
class StandingDisplacement {
 public:
  StandingDisplacement() = default;  // no errors
  StandingDisplacement(std::shared_ptr<const StandingErrors> influence, std::vector<double> errors)
      : influence_(std::move(influence)), errors_(std::move(errors)) {}

  explicit operator bool() const { return influence_ != nullptr; }
  // Whether these errors leave offsets of redundant joints somewhere that no coordinate says; and where, at t: in the order of OffsetLayout.
  bool shifts() const;
  struct Shift {
    VecX value, rate;
  };
  Shift shift(double t) const;
  const StandingErrors& influence() const { return *influence_; }
  Vec6 at(double t, int body) const;
  struct Motion {
    Vec6 value = Vec6::Zero(), rate = Vec6::Zero(), acceleration = Vec6::Zero();
  };
  Motion motion(double t, int body) const;

 private:
  // Of a body, contracted when first asked for.
  const TimeTable& table(std::map<int, TimeTable>& kept, int body, bool rate) const;

  std::shared_ptr<const StandingErrors> influence_;
  std::vector<double> errors_;
  mutable std::map<int, TimeTable> values_, rates_;
  mutable std::optional<TimeTable> shift_;
  mutable bool shifts_ = false;
};

}  // namespace boresight
