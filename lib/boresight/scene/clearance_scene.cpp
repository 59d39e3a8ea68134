#include "boresight/scene/clearance_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "boresight/formulations/exact_states.hpp"
#include "boresight/formulations/force_elements.hpp"
#include "boresight/math/dense_solves.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/mechanism/load_time.hpp"
#include "boresight/mechanism/motion_density.hpp"
#include "boresight/scene/acting_loads.hpp"
#include "boresight/scene/deviation_stiffness.hpp"
#include "boresight/scene/start_rates.hpp"
#include "boresight/scene/table_row.hpp"
#include "boresight/scene/tipping.hpp"

namespace boresight {
namespace {

// First grid, and the finest that accuracy is sought with [s]. A motion longer than kManyCells of the coarsest spacing starts with as
// many cells as its own table needs; one that is over, or turns, within the finest spacing is looked at more finely.
constexpr int kFewestCellsOfMotion = 8, kManyCells = 4096, kCellsOfKnot = 4;
constexpr double kCoarsestSpacing = 16e-3, kFinestSpacing = 1e-5;
// Knots of a kinematic motion's own table in a first cell: a radian of what is fastest in it.
constexpr double kKnotsOfCell = 16.0;
// The finest spacing is bounded by a share of that of the ideal motion's table, which is about a sixteenth of a radian of the fastest
// motion.
constexpr double kFinestOfKnot = 1e-3;

double spacing_of_knots(const IdealMotion& ideal) { return ideal.duration() / std::max(1, ideal.knots() - 1); }

// Share of the bodies' accelerations that the push of coordinates is rounding of.
constexpr double kRoundingOfPush = 1e-5;
// Of the tables, relative to their largest values: what is left at the finest spacing must not be more.
constexpr double kLargestMissOfTables = 0.01;

constexpr const char* kBuilding = "opening the mechanism at its clearances";

}  // namespace

ClearanceScene::ClearanceScene(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal)
    : mechanism_(mechanism),
      offsets_(mechanism),
      coordinates_(mechanism, ideal),
      layout_(offsets_, coordinates_,
              coordinates_.leftover() > 0 || moving() || !mechanism.description().springs.empty()),
      groups_(riding_masses(mechanism, parameters)) {
  Tipping tipping;
  try {
    tipping = tipped_by_all_loads(ideal, parameters);
  } catch (const ComputationError&) {
    // Where a pose near this one cannot be closed nothing is known of it; whoever needs that pose says so.
  }
  if (!tipping.clearances.empty()) {
    layout_ = SceneLayout(offsets_, coordinates_, true);
    layout_.tips = true;
    layout_.tipped = std::move(tipping.clearances);
  }
  layout_.undecided = std::move(tipping.undecided);
}

bool ClearanceScene::would_tip(const Mechanism& mechanism, const IdealMotion& ideal, const Parameters& parameters) {
  return ClearanceScene(mechanism, parameters, ideal).tips();
}

Tipping ClearanceScene::tipped_by_all_loads(const IdealMotion& ideal, const Parameters& parameters) {
  // Where a load pushes on every coordinate, no tilt or shift within the play makes one that counts beside it.
  constexpr double kPushes = 1e-3;
  const int n = layout_.n;
  if (coordinates_.leftover() > 0 || n == 0) return {};
  ExactStates exact(mechanism_, ideal);
  const Knot knot = knot_at(0.0, ideal, exact, parameters);
  MatX M, C;
  VecX r;
  assemble(parameters, knot, M, C, r);
  const std::vector<MassProperties> masses = mechanism_.mass_properties(parameters);
  VecX acting = VecX::Zero(n);
  double fastest = 0.0;  // turning [1/s^2]
  for (std::size_t b = 0; b < masses.size(); ++b) {
    const BodyAcceleration& a = knot.state.acceleration[b];
    const double turning = a.tail<3>().norm() + knot.state.bodies[b].w.squaredNorm();
    fastest = std::max(fastest, turning);
    add_to_coordinates(weight_and_inertia(masses[b], parameters.gravity.norm(), a.head<3>().norm(), turning),
                       static_cast<int>(b), knot.T, acting);
  }
  // Springs and loads push too, and may do so along what no play gives way to.
  const double most = r.size() > 0 ? r.cwiseAbs().maxCoeff() : 0.0;
  if (most > 0.0 && (r.cwiseAbs().array() >= kPushes * acting.cwiseMax(most).array()).all()) return {};
  acting = acting.cwiseMax(most);
  std::vector<double> row;
  append_row(parameters, knot, row, true);
  // Of the loads at a knot, without what hangs on the coordinates and not on where journals lie.
  const auto stiffness_at = [&](const Knot& at) {
    MatX K =
        M * deviation_stiffness(mechanism_, ideal, parameters, coordinates_, at.state, at.T, solve_positive(M, C), r);
    if (moving()) K -= moving_stiffness(parameters, at);
    return K;
  };
  Tipping tipping =
      tipped_by_loads(RestingBalance(layout_, row.data(), joint_plays(mechanism_.description(), parameters)), layout_,
                      stiffness_at(knot), acting);
  // What the motion's own turning makes of a displacement is over when it has turned.
  constexpr double kBesideTurning = 2.0;
  if (!tipping.clearances.empty() && !(tipping.fall > kBesideTurning * fastest * tipping.way.dot(M * tipping.way)))
    tipping.clearances.clear();
  // What loads push along the way later in the motion, or hold against it, they decide.
  constexpr double kLooks[] = {0.11, 0.29, 0.43, 0.61, 0.79, 0.97};
  for (const double share : kLooks) {
    if (tipping.clearances.empty()) break;
    const Knot later = knot_at(share * ideal.duration(), ideal, exact, parameters);
    assemble(parameters, later, M, C, r);
    if (std::abs(tipping.way.dot(r)) > tipping.fall || !(tipping.way.dot(stiffness_at(later) * tipping.way) < 0.0))
      tipping.clearances.clear();
  }
  return tipping;
}

SceneStart ClearanceScene::start_of(const Parameters& parameters, const Knot& first) const {
  SceneStart start{{}, start_rates(mechanism_, parameters, first.state, first.T, first.T_rate)};
  start.cancelled = kCancelledLoad * sum_of_acting_loads(mechanism_, parameters, first.state.t, first.state.bodies,
                                                         first.state.acceleration);
  append_row(parameters, first, start.row, true);
  return start;
}

ClearanceScene::Start ClearanceScene::at_start(const Mechanism& mechanism, const IdealMotion& ideal,
                                               const Parameters& parameters) {
  ClearanceScene scene(mechanism, parameters, ideal);
  ExactStates exact(mechanism, ideal);
  const Knot knot = scene.knot_at(0.0, ideal, exact, parameters);
  return {scene.layout_, scene.start_of(parameters, knot), knot.state, knot.T, knot.T_rate};
}

Parameters ClearanceScene::gridded_by(const Parameters& parameters) const {
  Parameters grid = parameters;
  grid.clearance = mechanism_.parameters().clearance;
  if (coordinates_.leftover() > 0 || tips()) return grid;
  grid = mechanism_.parameters();
  grid.body_center = parameters.body_center;
  grid.payload_center = parameters.payload_center;
  return grid;
}

ClearanceScene::ClearanceScene(const Mechanism& mechanism, const IdealMotion& ideal, const Parameters& parameters,
                               double accuracy)
    : ClearanceScene(mechanism, parameters, ideal) {
  const Parameters grid = gridded_by(parameters);
  // Halve the spacing until the coarse grid's cubics meet the new knots: the finer grid's own error is a sixteenth of that.
  const double knot_spacing = spacing_of_knots(ideal);
  const double finest = std::max(kFinestOfKnot * knot_spacing, std::min(kFinestSpacing, knot_spacing));
  double first_cells = std::max<double>(kFewestCellsOfMotion, std::ceil(mechanism.duration() / kCoarsestSpacing));
  if (first_cells > kManyCells)
    first_cells = std::max<double>(kManyCells, std::min(first_cells, 1.0 * kCellsOfKnot * ideal.knots()));
  // Nor is a motion that is fast for a moment passed over: where drives tell all of it, its own table has found that out.
  if (coordinates_.leftover() == 0)
    first_cells = std::max(first_cells, std::ceil((ideal.knots() - 1.0) / kKnotsOfCell));
  // What a load does within a cell is seen by no knot.
  load_time_ = boresight::load_time(mechanism);
  const double cells_of_loads = std::ceil(mechanism.duration() / (kCellOfLoads * load_time_));
  std::string fast_load;
  if (cells_of_loads > first_cells) {
    first_cells = cells_of_loads;
    char text[100];
    std::snprintf(text, sizeof text, ", as a load changes by all that it does within %.2g s", load_time_);
    fast_load = text;
  }
  // A knot's matrices, and its row in the tables.
  const double numbers = (6.0 * mechanism.bodies() + offsets_.size()) * layout_.n +
                         static_cast<double>(groups_.size()) * element_size() + 3.0 * layout_.width;
  const double bytes_of_knot =
      sizeof(Knot) + 8.0 * numbers + mechanism.bodies() * (sizeof(BodyMotion) + sizeof(BodyAcceleration));
  const auto refuse_unless_held = [&](double knots) {
    const double bytes = knots * bytes_of_knot;
    if (bytes <= kMostTableBytes) return;
    char text[400];
    std::snprintf(
        text, sizeof text,
        "the opened mechanism's dynamics over %.6g s would take %.2g GB of memory as a table (%.2g instants)%s; "
        "shorten motion.duration to what has to be seen, or use the multibody rung, which needs no table",
        mechanism.duration(), 1e-9 * bytes, knots, fast_load.c_str());
    throw MotionTooDense(text);
  };
  refuse_unless_held(2.0 * first_cells);
  // Where no play can move and nothing else is off, tables may hold rounding alone, which no finer grid makes smooth.
  const bool nothing_deviates = coordinates_.leftover() == layout_.n && mechanism.description().errors.empty();
  int cells = static_cast<int>(first_cells);
  spacing_ = mechanism.duration() / cells;
  std::vector<double> rows;
  ExactStates exact(mechanism, ideal);
  for (int k = 0; k <= cells; ++k) {
    work_reached(kBuilding, 0.5 * k / cells);
    knots_.push_back(knot_at(k * spacing_, ideal, exact, parameters));
  }
  for (;;) {
    refuse_unless_held(2.0 * cells);
    std::vector<Knot> finer;
    finer.reserve(2 * cells + 1);
    for (int k = 0; k < cells; ++k) {
      work_reached(kBuilding, 0.5 + 0.25 * k / cells);
      finer.push_back(std::move(knots_[k]));
      finer.push_back(knot_at((k + 0.5) * spacing_, ideal, exact, parameters));
    }
    finer.push_back(std::move(knots_[cells]));
    knots_ = std::move(finer);
    cells *= 2;
    spacing_ *= 0.5;
    rows.clear();
    for (int k = 0; k <= cells; ++k) {
      work_reached(kBuilding, 0.75 + 0.25 * k / cells);
      append_row(grid, knots_[k], rows);
    }
    const double error = interpolation_error(rows, grid);
    if (error <= 16.0 * accuracy) break;
    if (0.5 * spacing_ >= finest) continue;
    if (error <= kLargestMissOfTables || nothing_deviates) break;
    char text[300];
    std::snprintf(text, sizeof text,
                  "the opened mechanism's dynamics change by %.2g of their size within %.2g s: a singular pose is "
                  "near, or something "
                  "vibrates far faster than the motion; the multibody rung needs no table of them",
                  error, 2.0 * spacing_);
    throw ComputationError(text);
  }
  if (coordinates_.leftover() > 0 && moving()) let_contacts_share(grid, ideal, kLargestMissOfTables);
}

// The rate below which stiffness between the contacts does next to nothing to the deviation [1/s]: that of the motion, or that at which
// the loads cross the gaps where nothing but offsets deviates. What is small against it may be rounding, which no finer grid makes smooth.
double ClearanceScene::slowest_rate(const std::vector<double>& rows, const Parameters& parameters) const {
  const double of_motion = 1.0 / mechanism_.duration();
  if (coordinates_.leftover() > 0) return of_motion;
  double load = 0.0, gap = 0.0;
  for (std::size_t c = 0; c < layout_.joints.size(); ++c) {
    gap = std::max(gap, widest_gap(parameters.clearance[c]));
    for (int k = 0; k < 3; ++k)
      if (const int source = layout_.joints[c].source[k]; source >= 0)
        for (std::size_t row = 0; row < rows.size(); row += layout_.width)
          load = std::max(load, std::abs(rows[row + layout_.Ar + source]));
  }
  return gap > 0.0 ? std::max(of_motion, std::sqrt(load / gap)) : of_motion;
}

// Largest miss of the cubics through every other knot at the knots between, relative to the largest value of each group of
// functions.
double ClearanceScene::interpolation_error(const std::vector<double>& rows, const Parameters& parameters) const {
  const int width = layout_.width;
  if (width == 0) return 0.0;
  std::vector<double> coarse, between(width);
  for (std::size_t k = 0; k < knots_.size(); k += 2)
    coarse.insert(coarse.end(), rows.begin() + k * width, rows.begin() + (k + 1) * width);
  const TimeTable table(2.0 * spacing_, width, coarse);
  std::vector<int> ends = {layout_.Ar, layout_.AC, layout_.AK, layout_.joints_at};
  for (const SceneLayout::Joint& j : layout_.joints)
    for (int end : {j.spin_gain, j.spin_drift, j.slide, j.slide_gain, j.slide_drift, j.twist, j.dependent, j.shift})
      ends.push_back(end);
  ends.push_back(width);
  std::vector<double> miss(ends.size(), 0.0), size(ends.size(), 0.0);
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    const double* row = &rows[k * width];
    const bool odd = k % 2 == 1;
    if (odd) table.at(k * spacing_, between.data());
    int i = 0;
    for (std::size_t g = 0; g < ends.size(); ++g)
      for (; i < ends[g]; ++i) {
        size[g] = std::max(size[g], std::abs(row[i]));
        if (odd) miss[g] = std::max(miss[g], std::abs(row[i] - between[i]));
      }
  }
  const double rate = slowest_rate(rows, parameters);
  // The push is the difference of such numbers, of bodies with their weight, in whichever of m/s^2 and rad/s^2 is less. Next to nothing
  // against them it may be rounding alone, as where all plays are held.
  const double length = mechanism_.characteristic_length();
  for (const Knot& knot : knots_)
    for (const BodyAcceleration& a : knot.state.acceleration)
      size[1] = std::max(size[1], kRoundingOfPush / std::max(1.0, length) *
                                      std::max((a.head<3>() - parameters.gravity).norm(), length * a.tail<3>().norm()));
  size[2] = std::max(size[2], 1e-3 / mechanism_.duration());  // a thousandth of a speed is lost over the whole motion
  size[3] = std::max(size[3], rate * rate);
  for (std::size_t c = 0; c < layout_.joints.size();
       ++c)  // a drift against its gain: what the coordinates do within the motion
    for (const std::size_t gain : {5 + 8 * c, 8 + 8 * c})
      size[gain + 1] = std::max(size[gain + 1], size[gain] / mechanism_.duration());
  double worst = 0.0;
  for (std::size_t g = 0; g < ends.size(); ++g)
    if (size[g] > 1e-9) worst = std::max(worst, miss[g] / size[g]);
  return worst;
}

ClearanceScene::Knot ClearanceScene::knot_at(double t, const IdealMotion& ideal, ExactStates& exact,
                                             const Parameters& parameters) {
  Knot knot;
  knot.state = exact.at(t);
  coordinates_.gain(knot.state, knot.T);
  knot.B = coordinates_.offsets_per_coordinate(knot.T);
  MatX B_rate;
  coordinates_.rates(knot.T, knot.T_rate, knot.T_second, B_rate);
  add_joints(B_rate, knot);
  if (layout_.n == 0) return knot;  // no play can move
  knot.elements.assign(groups_.size() * element_size(), 0.0);
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (const RidingMass& element : groups_[g]) add_element(element, knot, &knot.elements[g * element_size()]);
  for (const SpringDescription& spring : mechanism_.description().springs)
    knot.springs.push_back(spring_gain(mechanism_.description(), spring, knot.state, knot.T, knot.T_rate));
  if (stiff_by_differences()) {
    MatX M, C;
    VecX r;
    assemble(parameters, knot, M, C, r);
    knot.stiffness =
        deviation_stiffness(mechanism_, ideal, parameters, coordinates_, knot.state, knot.T, solve_positive(M, C), r);
  }
  return knot;
}

}  // namespace boresight
