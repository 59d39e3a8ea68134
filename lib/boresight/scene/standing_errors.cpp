#include "boresight/scene/standing_errors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "boresight/math/cubic_at_middle.hpp"
#include "boresight/mechanism/course_fault.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/generic_instant.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/mechanism/load_time.hpp"
#include "boresight/mechanism/motion_density.hpp"

namespace boresight {
namespace {

constexpr const char* kFollowing = "following the influence of errors";

// First grid, and how often it is halved at most: a thousandth of the first spacing shows the ripple of ten thousand turns of a screw.
constexpr int kTabledBodies = 2;
constexpr int kFewestCellsOfColumns = 16, kMostHalvingsOfColumns = 12;
// What a law of time or of a drive's place does within a cell is overlooked: so many cells at most, so that none does that wholly.
constexpr int kMostCellsOfLaws = 1 << 14;
// What is left of the columns between the knots where the grid is finest must not be more.
constexpr double kLargestMissOfColumns = 1e-3;

std::string seconds(double time) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3g s", time);
  return text;
}

}  // namespace

StandingErrors::StandingErrors(const Mechanism& mechanism, const IdealMotion& commanded, std::vector<bool> wanted)
    : bodies_(mechanism.bodies()), wanted_(std::move(wanted)) {
  ErrorInfluence influence(mechanism, commanded);
  const double duration = mechanism.duration(), length = mechanism.characteristic_length();
  // A sixteenth of what the commanded motion is tabled with: no turn of it is overlooked.
  int cells = std::max(kFewestCellsOfColumns, commanded.knots() / 16);
  const auto held = [&](double knots) {
    // Knots, of all bodies; and of those that are asked for, the boresight body and now and then another one, two tables of four
    // coefficients a function.
    return knots * 8.0 * 6.0 * count() * (bodies_ + 8.0 * std::min(bodies_, kTabledBodies)) <= kMostTableBytes;
  };
  if (!held(2.0 * cells))
    throw MotionTooDense(
        "what standing errors do to the pose would take too much memory as a table over so long a motion; shorten "
        "motion.duration to what has to be seen, or use the multibody rung, which needs no table");
  // What asks for more from here on are the errors: one of them is named.
  const std::vector<double> times = error_times(mechanism, commanded, wanted_);
  const auto fastest = std::min_element(times.begin(), times.end());
  if (fastest != times.end()) {
    const double cells_of_laws = duration / (kCellOfLoads * least_error_time(mechanism, *fastest));
    cells = std::max(cells, static_cast<int>(std::min(cells_of_laws, double{kMostCellsOfLaws})));
    if (!held(2.0 * cells))
      throw ComputationError("error." + mechanism.description().errors[fastest - times.begin()].name +
                             " changes within " + seconds(*fastest) +
                             ": what standing errors do to the pose would take too much memory as a table that shows "
                             "it; the multibody rung needs no table of it");
  }
  const auto at = [&](double t) {
    MatX G;
    influence.at(t, wanted_, G);
    return G;
  };
  spacing_ = duration / cells;
  for (int k = 0; k <= cells; ++k) {
    work_reached(kFollowing, 0.5 * k / cells);
    knots_.push_back(at(std::min(duration, k * spacing_)));
  }
  // Lengths in units of the mechanism's own.
  VecX scale = VecX::Constant(6 * bodies_, 1.0);
  for (int b = 0; b < bodies_; ++b) scale.segment<3>(6 * b).setConstant(1.0 / length);
  for (int halving = 0;; ++halving) {
    std::vector<MatX> middles;
    Eigen::RowVectorXd largest = Eigen::RowVectorXd::Zero(count()), missed = largest, missed_at = largest;
    for (int k = 0; k < cells; ++k) {
      work_reached(kFollowing, 0.5 + 0.5 * k / cells);
      middles.push_back(at((k + 0.5) * spacing_));
      const MatX& middle = middles.back();
      const MatX cubic = cubic_at_middle(knots_, k);
      const Eigen::RowVectorXd off = (scale.asDiagonal() * (middle - cubic)).cwiseAbs().colwise().maxCoeff();
      missed_at = (off.array() > missed.array()).select((k + 0.5) * spacing_, missed_at);
      missed = missed.cwiseMax(off);
      largest = largest.cwiseMax((scale.asDiagonal() * middle).cwiseAbs().colwise().maxCoeff());
    }
    std::vector<MatX> finer;
    finer.reserve(static_cast<std::size_t>(2 * cells) + 1);
    for (std::size_t k = 0; k < middles.size(); ++k) {
      finer.push_back(std::move(knots_[k]));
      finer.push_back(std::move(middles[k]));
    }
    finer.push_back(std::move(knots_.back()));
    knots_ = std::move(finer);
    cells *= 2;
    spacing_ *= 0.5;
    Miss miss;
    for (int e = 0; e < count(); ++e)
      if (largest[e] > 0.0) miss.add(missed[e] / largest[e], static_cast<std::size_t>(e), missed_at[e]);
    // What goes on a whole number of times between instants that halve the motion again and again is a constant at all of them.
    if (miss.share <= 16.0 * kAccuracy) miss = missed_elsewhere(at, scale, largest);
    // The finer grid's own error is a sixteenth of what the coarser one missed.
    if (miss.share <= 16.0 * kAccuracy) break;
    const bool last = halving == kMostHalvingsOfColumns;
    if (last && miss.share <= kLargestMissOfColumns) break;
    if (last || !held(2.0 * cells))
      refuse_column(mechanism, commanded, miss, spacing_,
                    last ? ", where a singular pose is near"
                         : ", which would take too much memory as a table over the whole motion");
  }
  table_shifts(influence);
}

void StandingErrors::refuse_column(const Mechanism& mechanism, const IdealMotion& commanded, const Miss& miss,
                                   double spacing, const char* unless_by_law) {
  const ErrorDescription& error = mechanism.description().errors[miss.error];
  // Whether the law alone is missed there by as much as the column, or the pose has a part in it.
  bool by_law = false;
  if (error.law) {
    const auto law = [&](double t) { return error.law->at(commanded.drive_law(t, error.joint), t).value; };
    double largest = std::abs(law(miss.t)), off = law(miss.t);
    // The four knots of the coarser grid around the middle of a cell.
    constexpr double kWeight[] = {-1.0 / 16.0, 9.0 / 16.0, 9.0 / 16.0, -1.0 / 16.0};
    for (int i = 0; i < 4; ++i) {
      const double there = law(std::clamp(miss.t + (2.0 * i - 3.0) * spacing, 0.0, mechanism.duration()));
      largest = std::max(largest, std::abs(there));
      off -= kWeight[i] * there;
    }
    constexpr double kAsMuch = 0.1;
    by_law = std::abs(off) >= kAsMuch * miss.share * largest;
  }
  throw ComputationError("what error." + error.name + " does to the pose changes within " + seconds(spacing) +
                         at_time(miss.t) +
                         (by_law ? ", as its law does there, which no table of the motion follows" : unless_by_law) +
                         "; the multibody rung needs no table of it");
}

StandingErrors::Miss StandingErrors::missed_elsewhere(const std::function<MatX(double)>& at, const VecX& scale,
                                                      const Eigen::RowVectorXd& largest) const {
  // Cells in no order that a motion has, each at a place of its own.
  constexpr int kPlaces = 29;
  constexpr double kGolden = 0.6180339887498949;
  Miss missed;
  for (int i = 1; i <= kPlaces; ++i) {
    const double place = std::fmod(i * kGolden, 1.0) * cells();
    const int k = std::min(static_cast<int>(place), cells() - 1);
    const MatX off = at(place * spacing_) - cubic_at(knots_, k, place - k);
    const Eigen::RowVectorXd size = (scale.asDiagonal() * off).cwiseAbs().colwise().maxCoeff();
    for (Eigen::Index e = 0; e < size.size(); ++e)
      if (size[e] > 0.0)
        missed.add(size[e] / std::max(largest[e], size[e]), static_cast<std::size_t>(e), place * spacing_);
  }
  return missed;
}

// Of the knots there are now.
void StandingErrors::table_shifts(ErrorInfluence& influence) {
  if (!influence.shifts()) return;
  std::vector<double> values;
  MatX G;
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    influence.at(static_cast<double>(k) * spacing_, wanted_, G);
    const MatX& shift = influence.shift();
    for (Eigen::Index row = 0; row < shift.rows(); ++row)
      for (Eigen::Index e = 0; e < shift.cols(); ++e) values.push_back(shift(row, e));
  }
  shift_ = TimeTable(spacing_, influence.offsets().size() * count(), values);
  shifts_ = true;
}

std::shared_ptr<const StandingErrors> StandingErrors::of_all(const Mechanism& mechanism, const IdealMotion& commanded) {
  ErrorInfluence influence(mechanism, commanded);
  const auto count = static_cast<std::size_t>(influence.count());
  std::vector<bool> wanted(count, true);
  std::vector<std::string> refusal(count);
  const auto leave_out_what_strains_at = [&](double t) {
    for (std::size_t e = 0; e < count; ++e) {
      if (!wanted[e]) continue;
      std::vector<bool> alone(count, false);
      alone[e] = true;
      MatX G;
      try {
        influence.at(t, alone, G);
      } catch (const ComputationError& strained) {
        wanted[e] = false;
        refusal[e] = strained.what();
      }
    }
  };
  leave_out_what_strains_at(generic_instant(0.0, mechanism.duration()));
  const auto table = [&] {
    const auto all = std::make_shared<StandingErrors>(mechanism, commanded, wanted);
    all->refusal_ = refusal;
    return all;
  };
  try {
    return table();
  } catch (const MotionTooDense&) {
    throw;
  } catch (const ComputationError&) {
    // One that is taken up at one instant may strain at another.
    const auto before = std::count(wanted.begin(), wanted.end(), true);
    for (int k = 0; k <= kFewestCellsOfColumns; ++k)
      leave_out_what_strains_at(mechanism.duration() * k / kFewestCellsOfColumns);
    if (std::count(wanted.begin(), wanted.end(), true) == before) throw;
  }
  return table();
}

void StandingErrors::require(const std::vector<double>& errors) const {
  for (std::size_t e = 0; e < errors.size(); ++e)
    if (errors[e] != 0.0 && !wanted_[e])
      throw ComputationError(refusal_.empty() ? "an error that no column was computed for" : refusal_[e]);
}

const TimeTable& StandingErrors::kept(std::map<int, TimeTable>& tables, int body, bool rate) const {
  const std::lock_guard lock(mutex_);
  if (const auto found = tables.find(body); found != tables.end()) return found->second;
  const int width = 6 * count();
  std::vector<double> values;
  values.reserve(knots_.size() * static_cast<std::size_t>(width));
  for (const MatX& knot : knots_)
    for (int row = 0; row < 6; ++row)
      for (int e = 0; e < count(); ++e) values.push_back(knot(6 * body + row, e));
  const TimeTable table(spacing_, width, values);
  if (!rate) return tables.emplace(body, table).first->second;
  std::vector<double> slopes(values.size());
  for (std::size_t k = 0; k < knots_.size(); ++k)
    table.slopes(static_cast<double>(k) * spacing_, slopes.data() + k * static_cast<std::size_t>(width));
  return tables.emplace(body, TimeTable(spacing_, width, slopes)).first->second;
}

const TimeTable& StandingErrors::gain(int body) const { return kept(gain_, body, false); }
const TimeTable& StandingErrors::gain_rate(int body) const { return kept(gain_rate_, body, true); }

const TimeTable& StandingDisplacement::table(std::map<int, TimeTable>& kept, int body, bool rate) const {
  if (const auto found = kept.find(body); found != kept.end()) return found->second;
  const TimeTable& gain = rate ? influence_->gain_rate(body) : influence_->gain(body);
  return kept.emplace(body, gain.contracted(errors_)).first->second;
}

bool StandingErrors::uses_play(std::size_t error) const {
  if (!shifts_) return false;
  std::vector<double> alone(static_cast<std::size_t>(count()), 0.0);
  alone[error] = 1.0;
  const TimeTable of_unit = shift_.contracted(alone);
  std::vector<double> values(static_cast<std::size_t>(of_unit.width()));
  // Of a unit, a metre or a radian: what is below is rounding.
  constexpr double kRounding = 1e-9;
  for (int k = 0; k <= of_unit.cells(); ++k) {
    of_unit.at(k * of_unit.spacing(), values.data());
    for (const double value : values)
      if (std::abs(value) > kRounding) return true;
  }
  return false;
}

bool StandingDisplacement::shifts() const {
  if (!influence_ || !influence_->shifts()) return false;
  if (shift_) return shifts_;
  shift_ = influence_->shift().contracted(errors_);
  std::vector<double> values(static_cast<std::size_t>(shift_->width()));
  // Below a picometre in a metre it is rounding.
  constexpr double kRounding = 1e-12;
  for (int k = 0; k <= shift_->cells(); ++k) {
    shift_->at(k * shift_->spacing(), values.data());
    for (const double value : values) shifts_ = shifts_ || std::abs(value) > kRounding;
  }
  return shifts_;
}

StandingDisplacement::Shift StandingDisplacement::shift(double t) const {
  Shift shift;
  if (!shifts()) return shift;
  shift.value.resize(shift_->width());
  shift.rate.resize(shift_->width());
  shift_->at(t, shift.value.data());
  shift_->slopes(t, shift.rate.data());
  return shift;
}

Vec6 StandingDisplacement::at(double t, int body) const {
  Vec6 value = Vec6::Zero();
  if (influence_) table(values_, body, false).at(t, value.data());
  return value;
}

StandingDisplacement::Motion StandingDisplacement::motion(double t, int body) const {
  Motion motion;
  if (!influence_) return motion;
  const TimeTable& rates = table(rates_, body, true);
  table(values_, body, false).at(t, motion.value.data());
  rates.at(t, motion.rate.data());
  rates.slopes(t, motion.acceleration.data());
  return motion;
}

}  // namespace boresight
