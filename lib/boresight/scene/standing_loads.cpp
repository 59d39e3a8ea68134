#include "boresight/scene/standing_loads.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/math/cubic_at_middle.hpp"
#include "boresight/mechanism/built_mechanism.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/scene/deviation_coordinates.hpp"
#include "boresight/scene/riding_masses.hpp"

namespace boresight {
namespace {

constexpr const char* kTabling = "tabling what standing errors change of the loads";

// First grid, how often it is halved at most, and what may then be left between the knots.
constexpr int kFewestCellsOfLoads = 16, kMostHalvingsOfLoads = 12;
constexpr double kLargestMissOfLoads = 0.05;
// The little of an error that the mechanism is built with, in turns or lengths of the mechanism's size: joints close to 1e-13, which leaves
// 1e-8 of a column, and what is of second order another 1e-5.
constexpr double kLittle = 1e-5;
// Below this share of the loads a column's rounding is no shape that a grid has to meet.
constexpr double kNextToNoLoad = 1e-3;

bool same_loads(const Parameters& a, const Parameters& b) {
  return a.gravity == b.gravity && a.payload_mass == b.payload_mass && a.body_mass == b.body_mass &&
         a.spring == b.spring;
}

// Knots of a grid and what lies in the middle of its cells, in order.
std::vector<VecX> between_each(std::vector<VecX> knots, std::vector<VecX> middles) {
  std::vector<VecX> finer;
  finer.reserve(knots.size() + middles.size());
  for (std::size_t k = 0; k < middles.size(); ++k) {
    finer.push_back(std::move(knots[k]));
    finer.push_back(std::move(middles[k]));
  }
  finer.push_back(std::move(knots.back()));
  return finer;
}

}  // namespace

// r of one mechanism, closed exactly where it is asked for.
class StandingLoads::Instants {
 public:
  Instants(std::shared_ptr<const Mechanism> mechanism, const IdealMotion& commanded, const OffsetChoice& choice,
           const Parameters& parameters)
      : mechanism_(std::move(mechanism)),
        commanded_(commanded),
        parameters_(parameters),
        solver_(*mechanism_),
        coordinates_(*mechanism_, commanded, choice),
        masses_(riding_masses(*mechanism_, parameters)) {}

  // Of each group n numbers and n x 3 per unit of gravity; then n of springs and loads.
  VecX parts(double t) {
    commanded_.state(t, state_);
    if (!solver_.solve(t, state_))
      throw ComputationError("the joints of the mechanism as it is built do not close at t = " + std::to_string(t) +
                             " s: an error is too large, or the pose is singular");
    coordinates_.gain(state_, T_);
    const Eigen::Index n = T_.cols(), groups = static_cast<Eigen::Index>(masses_.size());
    VecX parts = VecX::Zero((4 * groups + 1) * n);
    for (Eigen::Index g = 0; g < groups; ++g)
      for (const RidingMass& mass : masses_[static_cast<std::size_t>(g)])
        add_load(mass, state_, T_, &parts[4 * g * n], &parts[(4 * g + 1) * n]);
    VecX forces = VecX::Zero(n);
    add_load_of_forces(*mechanism_, parameters_, state_, T_, forces);
    parts.tail(n) = forces;
    return parts;
  }
  // Kept: grids of different errors share their instants.
  const VecX& parts_once(double t) {
    const auto found = kept_.find(t);
    return found != kept_.end() ? found->second : kept_.emplace(t, parts(t)).first->second;
  }

 private:
  std::shared_ptr<const Mechanism> mechanism_;
  const IdealMotion& commanded_;
  Parameters parameters_;
  IdealSolver solver_;
  DeviationCoordinates coordinates_;
  std::vector<std::vector<RidingMass>> masses_;
  IdealState state_;
  MatX T_;
  std::map<double, VecX> kept_;
};

struct StandingLoads::Parts {
  std::unique_ptr<Instants> built;  // with a little of the error; none where that displaces nothing
  double size = 0.0, little = 0.0;  // what a unit of the error displaces; how much of the error it is built with
  int first_cells = 0;
  std::vector<VecX> at_knot;  // per unit of the error, on the finest grid that any sample has asked for

  int cells() const { return static_cast<int>(at_knot.size()) - 1; }
};

StandingLoads::StandingLoads(const Mechanism& drawn, const IdealMotion& commanded)
    : mechanism_(drawn), commanded_(std::shared_ptr<const IdealMotion>(), &commanded) {
  Parameters none = drawn.parameters();
  std::fill(none.error.begin(), none.error.end(), 0.0);
  as_drawn_ = built_mechanism(drawn, none, commanded_);
  choice_ = choose_offsets(drawn, commanded);
  unit_ = VecX::Ones(static_cast<Eigen::Index>(choice_.chosen.size()));
  const OffsetLayout offsets(drawn);
  for (int c = 0; c < offsets.clearances(); ++c)
    for (int k = 3; k < offsets.joint(c).count(); ++k)
      if (const int source = choice_.source[offsets.joint(c).first + k]; source >= 0)
        unit_[source] = drawn.characteristic_length();
}
StandingLoads::~StandingLoads() = default;

VecX StandingLoads::assembled(const VecX& parts, const Parameters& parameters) const {
  const Eigen::Index n = unit_.size(), groups = parts.size() / n / 4;
  VecX r = parts.tail(n);
  for (Eigen::Index g = 0; g < groups; ++g)
    r += units_of(static_cast<std::size_t>(g), mechanism_, parameters) *
         (parts.segment(4 * g * n, n) + Eigen::Map<const MatX>(&parts[(4 * g + 1) * n], n, 3) * parameters.gravity);
  return r;
}

// Of what one unit of an error displaces, in turns or lengths of the mechanism's size.
double StandingLoads::size_of(std::size_t error, const StandingErrors& influence) const {
  const MechanismDescription& m = mechanism_.description();
  const double length = mechanism_.characteristic_length();
  double size = 0.0;
  for (const FrameError& frame : frame_errors(m, m.errors[error]))
    size = std::max(size, frame.displacement().norm() / length + frame.rotation.norm());
  for (int k = 0; k <= influence.cells(); ++k)
    for (int b = 0; b < mechanism_.bodies(); ++b) {
      const auto moved = influence.at_knot(k, b).col(static_cast<Eigen::Index>(error));
      size = std::max({size, moved.head<3>().norm() / length, moved.tail<3>().norm()});
    }
  return size;
}

StandingLoads::Parts& StandingLoads::parts(std::size_t error, const Parameters& parameters,
                                           const StandingErrors& influence) const {
  if (!drawn_ || parts_of_.spring != parameters.spring) {
    parts_.clear();
    parts_of_ = parameters;
    drawn_ = std::make_unique<Instants>(as_drawn_, *commanded_, choice_, parts_of_);
  }
  const auto found = parts_.find(error);
  if (found != parts_.end()) return found->second;
  Parts first;
  first.size = size_of(error, influence);
  if (first.size > 0.0) {
    Parameters with = parts_of_;
    std::fill(with.error.begin(), with.error.end(), 0.0);
    first.little = with.error[error] = kLittle / first.size;
    first.built = std::make_unique<Instants>(built_mechanism(mechanism_, with, commanded_), *commanded_, choice_, with);
    // As fine as the influence's own first grid: no turn of the motion is overlooked.
    first.first_cells = std::max(kFewestCellsOfLoads, commanded_->knots() / 16);
    // Nor a ripple of a drive, which the influence's grid has found out.
    if (mechanism_.description().errors[error].kind == ErrorDescription::Kind::drive)
      first.first_cells = std::max(first.first_cells, influence.cells() / 4);
    for (int k = 0; k <= first.first_cells; ++k) {
      work_reached(kTabling, 0.5 * k / first.first_cells);
      first.at_knot.push_back(change_at(first, time_of(k, first.first_cells)));
    }
  }
  return parts_.emplace(error, std::move(first)).first->second;
}

double StandingLoads::time_of(int knot, int cells) const {
  return std::min(mechanism_.duration(), mechanism_.duration() * knot / cells);
}

VecX StandingLoads::change_at(Parts& of, double t) const {
  return (of.built->parts(t) - drawn_->parts_once(t)) / of.little;
}

void StandingLoads::halve(Parts& of) const {
  const int cells = of.cells();
  std::vector<VecX> middles;
  for (int k = 0; k < cells; ++k) {
    work_reached(kTabling, 0.5 + 0.5 * k / cells);
    middles.push_back(change_at(of, time_of(2 * k + 1, 2 * cells)));
  }
  of.at_knot = between_each(std::move(of.at_knot), std::move(middles));
}

// The grid is the first of those halved again and again that serves these parameters, and its knots are the same instants however deep others
// have had it: what a sample gets does not hang on which came before.
StandingLoads::Columns::Column StandingLoads::column(std::size_t error, Parts& of, const Parameters& parameters) const {
  if (!of.built) return {};
  const auto units = [&](const VecX& part) { return VecX(assembled(part, parameters).cwiseQuotient(unit_)); };
  int cells = of.first_cells;
  std::vector<VecX> knots;  // in units of each coordinate's load
  double load = 0.0;        // the largest, in forces, per unit of the error
  for (int k = 0; k <= cells; ++k) {
    knots.push_back(units(of.at_knot[static_cast<std::size_t>(k * (of.cells() / cells))]));
    load = std::max(load, units(drawn_->parts_once(time_of(k, cells))).cwiseAbs().maxCoeff());
  }
  load *= of.size;
  for (int halving = 0;; ++halving) {
    if (of.cells() == cells) halve(of);
    const int stride = of.cells() / (2 * cells);
    std::vector<VecX> middles;
    VecX largest = VecX::Zero(unit_.size()), missed = largest;
    for (int k = 0; k < cells; ++k) {
      middles.push_back(units(of.at_knot[static_cast<std::size_t>((2 * k + 1) * stride)]));
      missed = missed.cwiseMax((middles.back() - cubic_at_middle(knots, k)).cwiseAbs());
      largest = largest.cwiseMax(middles.back().cwiseAbs());
    }
    knots = between_each(std::move(knots), std::move(middles));
    cells *= 2;
    const double floor = kNextToNoLoad * std::max(load, largest.maxCoeff());
    double miss = 0.0;
    for (Eigen::Index i = 0; i < missed.size(); ++i)
      if (const double scale = std::max(largest[i], floor); scale > 0.0) miss = std::max(miss, missed[i] / scale);
    // The finer grid's own error is a sixteenth of what the coarser one missed.
    if (miss <= 16.0 * kAccuracy) break;
    if (halving < kMostHalvingsOfLoads) continue;
    if (miss <= kLargestMissOfLoads) break;
    throw ComputationError("what error." + mechanism_.description().errors[error].name +
                           " changes of the loads in the joints ripples within " +
                           std::to_string(mechanism_.duration() / cells) +
                           " s: too fast for a table; the multibody rung needs none");
  }
  const Eigen::Index n = unit_.size();
  Columns::Column column{cells, VecX(n * (cells + 1))};
  const int stride = of.cells() / cells;
  for (int k = 0; k <= cells; ++k)
    column.values.segment(n * k, n) = assembled(of.at_knot[static_cast<std::size_t>(k * stride)], parameters);
  return column;
}

std::shared_ptr<const StandingLoads::Columns> StandingLoads::columns(const Parameters& parameters,
                                                                     const StandingErrors& influence) const {
  const std::lock_guard lock(mutex_);
  const bool same = columns_ && same_loads(columns_->of, parameters);
  const auto missing = [&](std::size_t e) {
    return parameters.error[e] != 0.0 && !(same && columns_->of_error.contains(e));
  };
  bool whole = same;
  for (std::size_t e = 0; e < parameters.error.size(); ++e) whole = whole && !missing(e);
  if (whole) return columns_;
  auto more = same ? std::make_shared<Columns>(*columns_) : std::make_shared<Columns>();
  more->of = parameters;
  for (std::size_t e = 0; e < parameters.error.size(); ++e) {
    if (!missing(e)) continue;
    more->of_error[e] = column(e, parts(e, parameters, influence), parameters);
  }
  return columns_ = std::move(more);
}

StandingLoads::Change StandingLoads::change(const Parameters& parameters, const StandingErrors& influence) const {
  const Eigen::Index n = unit_.size();
  if (n == 0) return {};
  const std::shared_ptr<const Columns> all = columns(parameters, influence);
  std::map<int, VecX> sums;  // by cells
  for (const auto& [e, column] : all->of_error) {
    if (parameters.error[e] == 0.0 || column.cells == 0) continue;
    VecX& sum = sums[column.cells];
    if (sum.size() == 0) sum = VecX::Zero(column.values.size());
    sum += parameters.error[e] * column.values;
  }
  if (sums.empty()) return {};
  const int cells = sums.rbegin()->first;
  VecX values = std::move(sums.rbegin()->second);
  sums.erase(std::prev(sums.end()));
  const double spacing = mechanism_.duration() / cells;
  for (const auto& [coarse, sum] : sums) {
    const TimeTable table(mechanism_.duration() / coarse, static_cast<int>(n), {sum.begin(), sum.end()});
    for (int k = 0; k <= cells; ++k) table.add(k * spacing, &values[n * k]);
  }
  return {spacing, {values.begin(), values.end()}};
}

}  // namespace boresight
