#include "boresight/lanes/perturbation_lanes.hpp"

#include <algorithm>
#include <cmath>
#include <list>
#include <mutex>
#include <stdexcept>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/lanes/scene_for_lanes.hpp"
#include "boresight/math/dense_solves.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/load_time.hpp"
#include "boresight/scene/resting_start.hpp"
#include "boresight/scene/standing_columns.hpp"
#include "boresight/scene/standing_curvature.hpp"

namespace boresight {
namespace {

constexpr int kPad = 16;  // lanes of the widest register
// A contact begins this close to where the journal meets the sleeve, as a share of what the tolerance lets a step err by.
constexpr double kGapShare = 0.1;
// A coordinate that the scene hardly loads is asked for no less than this share of the quickest one's rate.
constexpr double kSlowestCrossing = 0.03;
// The longest step that holds the scene's matrices still, as a share of that over which they are lines, at kLaneTolerance. It leaves out
// h^2 M' / (6 M T) of a flight of T: 3e-4 where the scene turns once in a hundred longest steps and T is a tenth of that. Its square goes
// with the tolerance.
constexpr double kHeldShare = 0.5;
// The longest step in cells of the errors' table, whose cubics meet them to 1e-7: a parabola across eight of these misses some 1e-3.
constexpr double kCellsOfErrors = 8.0;
// The same of what errors change of the loads: straight lines across a step, of tables of a thousandth.
constexpr double kCellsOfLoads = 0.5;
// Of scenes of different masses: kept for samples to come, and held by the samples of one call.
constexpr std::size_t kScenesKept = 64;
constexpr double kMostBytesKept = 2.5e8, kMostBytesHeld = 1e9;

// Of the boresight body's displacement and turn at t: the index to first order is the length of its product with them.
Eigen::Matrix<double, 3, 6> gain_of_displacement(const Mechanism& mechanism, const IdealMotion& motion,
                                                 PointingQuantity quantity, double t) {
  const BodyMotion ideal = motion.body(t, mechanism.boresight_body());
  return error_gain(quantity, {ideal.p, Quat(ideal.R)}, ideal.R * mechanism.boresight_B(),
                    mechanism.pointing().line_of_sight);
}

// G at t, 3 x n: without standing errors the index to first order is |G z|.
MatX index_gain(const Mechanism& mechanism, const PreparedScene& prepared, PointingQuantity quantity, double t) {
  const TimeTable& table = prepared.pose_gain(mechanism.boresight_body());
  std::vector<double> row(table.width());
  table.at(t, row.data());
  const Eigen::Index n = table.width() / 6;
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> E(row.data(), 6, n);
  return gain_of_displacement(mechanism, prepared.ideal(), quantity, t) * E;
}

// Whether errors may take up play of redundant joints, and shift offsets that are no coordinates: a scene of each sample's own, which is the
// rung's. Where freedoms are left that nothing drives the rung refuses errors.
bool offsets_are_tied(const Mechanism& mechanism) {
  if (!is_kinematic(mechanism)) return true;
  try {
    return choose_offsets(mechanism, ideal_motion(mechanism, mechanism.parameters())).has_dependent;
  } catch (const ComputationError&) {
    return true;
  }
}

// The ideal reactions' accelerations of the coordinates, from one row.
VecX accelerations(const LaneScene& scene, const double* row) {
  const SceneLayout& at = *scene.layout;
  const VecX r = Eigen::Map<const VecX>(row + at.Ar, at.n);
  if (scene.form == SceneForm::accelerations) return r;
  MatX M;
  at.inverse_mass(row, M);  // which M's place is
  return solve_positive(M, r);
}

}  // namespace

struct PerturbationLanes::Prepared {
  Parameters parameters;
  std::shared_ptr<const PreparedScene> scene;
  std::shared_ptr<const SceneTables> tables;
  std::vector<double> in_double;
  std::vector<float> in_single;
  std::vector<LanePlaces> places;
  VecX acceleration;  // root mean square of the ideal reactions' accelerations of each coordinate
  LaneScene lane;

  double bytes() const { return 12.0 * static_cast<double>(in_double.size()); }
};

// What standing errors do to the index of one scene.
struct PerturbationLanes::ErrorsOverTime {
  std::shared_ptr<const StandingErrors> influence;
  StandingColumns columns;
  StandingCurvature curvature;
};

struct PerturbationLanes::Cache {
  std::mutex mutex;
  std::shared_ptr<const PreparedScene> scene;
  std::shared_ptr<const TimeTable> gain;  // G over time, which no mass changes
  std::mutex errors_mutex;
  std::shared_ptr<const PreparedScene> errors_scene;  // whose errors these are
  std::shared_ptr<const ErrorsOverTime> errors;
  Parameters scene_parameters;
  std::list<std::shared_ptr<const Prepared>> prepared;  // the latest first
};

bool PerturbationLanes::serve(const Mechanism& mechanism) {
  if (!mechanism.description().errors.empty() && offsets_are_tied(mechanism)) return false;
  for (const JointPlay& law : joint_plays(mechanism.description(), mechanism.parameters())) {
    const auto* journal = std::get_if<JournalInSleeve>(&law.kind);
    if (journal == nullptr || journal->radial_law.curve != ElasticCurve::point || law.sticks) return false;
    const FrictionKind friction = journal->friction.kind;
    if (friction != FrictionKind::modified_coulomb && friction != FrictionKind::none) return false;
  }
  return mechanism.clearances() > 0;
}

PerturbationLanes::PerturbationLanes(std::shared_ptr<const Mechanism> mechanism, PointingQuantity quantity,
                                     double start, std::vector<double> typical)
    : mechanism_(std::move(mechanism)),
      quantity_(quantity),
      start_(start),
      typical_errors_(std::move(typical)),
      cache_(std::make_unique<Cache>()) {
  // A step takes a quarter of a radian of what is fastest in a motion that drives tell, as its own table has found it out.
  constexpr double kKnotsOfStep = 4.0;
  const auto prepared = prepared_for(mechanism_->parameters());
  const IdealMotion& ideal = prepared->scene->ideal();
  longest_step_ = kStepOfLoads * prepared->scene->load_time();
  if (prepared->scene->scene().coordinates().leftover() == 0)
    longest_step_ = std::min(longest_step_, kKnotsOfStep * ideal.duration() / std::max(1, ideal.knots() - 1));
}
PerturbationLanes::~PerturbationLanes() = default;

std::shared_ptr<const TimeTable> PerturbationLanes::gain_over_time(const PreparedScene& scene) const {
  const double spacing = scene.scene().spacing();
  std::vector<double> gains;
  int width = 0;
  for (int k = 0; k < scene.scene().knots(); ++k) {
    const MatX G = index_gain(*mechanism_, scene, quantity_, std::min(k * spacing, mechanism_->duration()));
    for (int i = 0; i < 3; ++i)
      for (Eigen::Index j = 0; j < G.cols(); ++j) gains.push_back(G(i, j));
    width = static_cast<int>(G.size());
  }
  return std::make_shared<const TimeTable>(spacing, width, gains);
}

// Looks the scene up, or computes it with nobody waiting: threads with other masses do so side by side.
std::shared_ptr<const PerturbationLanes::Prepared> PerturbationLanes::prepared_for(const Parameters& parameters) const {
  auto p = std::make_shared<Prepared>();
  p->parameters = parameters;
  std::shared_ptr<const TimeTable> gain_table;
  Parameters its_own;
  {
    const std::lock_guard lock(cache_->mutex);
    for (auto it = cache_->prepared.begin(); it != cache_->prepared.end(); ++it)
      if (same_scene((*it)->parameters, parameters)) {
        cache_->prepared.splice(cache_->prepared.begin(), cache_->prepared, it);
        return cache_->prepared.front();
      }
    p->scene = cache_->scene;
    gain_table = cache_->gain;
    its_own = cache_->scene_parameters;
  }
  if (!p->scene || !serves(*mechanism_, *p->scene, its_own, parameters)) {
    const std::lock_guard lock(cache_->mutex);
    // Another thread may have been here in the meantime.
    if (!cache_->scene || cache_->scene == p->scene ||
        !serves(*mechanism_, *cache_->scene, cache_->scene_parameters, parameters)) {
      cache_->scene = scene_for_lanes(*mechanism_, parameters);
      cache_->scene_parameters = parameters;
      if (cache_->scene->scene().layout().n > 0) cache_->gain = gain_over_time(*cache_->scene);
    }
    p->scene = cache_->scene;
    gain_table = cache_->gain;
  }
  LaneScene& lane = p->lane;
  lane.form = lane_form(p->scene->scene().layout());
  p->tables = std::make_shared<const SceneTables>(p->scene->scene().tables(parameters, lane.form));
  const int n = p->tables->layout.n;
  if (n == 0) return p;  // no play can move: nothing to follow, and no gain either

  const TimeTable &dynamics = p->tables->dynamics, &gain = *gain_table;
  lane.gain = dynamics.width();
  lane.width = (dynamics.width() + 3 * n + kPad - 1) / kPad * kPad;
  lane.cells = dynamics.cells();
  lane.per_spacing = 1.0 / dynamics.spacing();
  lane.duration = mechanism_->duration();
  lane.layout = &p->tables->layout;
  p->in_double.assign(static_cast<std::size_t>(lane.cells) * 4 * lane.width, 0.0);
  for (int cell = 0; cell < lane.cells; ++cell)
    for (int power = 0; power < 4; ++power) {
      double* to = &p->in_double[(static_cast<std::size_t>(cell) * 4 + power) * lane.width];
      std::copy_n(dynamics.cell(cell) + power * dynamics.width(), dynamics.width(), to);
      std::copy_n(gain.cell(cell) + power * gain.width(), gain.width(), to + lane.gain);
    }
  p->in_single.assign(p->in_double.begin(), p->in_double.end());
  lane.in_double = p->in_double.data();
  lane.in_single = p->in_single.data();

  for (const JointPlay& law : joint_plays(mechanism_->description(), parameters)) {
    LanePlaces places;
    for (ContactPlace place : law.places()) places.place[places.count++] = place;
    p->places.push_back(places);
  }
  lane.places = p->places.data();

  p->acceleration = VecX::Zero(n);
  for (int cell = 0; cell < lane.cells; ++cell)
    p->acceleration += accelerations(lane, dynamics.cell(cell)).cwiseAbs2() / lane.cells;
  p->acceleration = p->acceleration.cwiseSqrt();
  const std::lock_guard lock(cache_->mutex);
  cache_->prepared.push_front(p);
  const auto kept = static_cast<std::size_t>(std::max(1.0, kMostBytesKept / p->bytes()));
  if (cache_->prepared.size() > std::min(kScenesKept, kept)) cache_->prepared.pop_back();
  return p;
}

void PerturbationLanes::run(std::span<const Parameters> samples, std::span<LaneOutcome> outcomes, double tolerance,
                            const LaneWatch& watch) const {
  run(lane_targets(lane_precision(tolerance)).front(), samples, outcomes, tolerance, watch);
}

// Of one scene, computed when the first sample with errors comes.
std::shared_ptr<const PerturbationLanes::ErrorsOverTime> PerturbationLanes::errors_for(
    const std::shared_ptr<const PreparedScene>& scene) const {
  const std::lock_guard lock(cache_->errors_mutex);
  if (cache_->errors && cache_->errors_scene == scene) return cache_->errors;
  const IdealMotion& ideal = scene->ideal();
  const std::shared_ptr<const StandingErrors> influence = StandingErrors::of_all(*mechanism_, ideal);
  StandingColumns columns(*influence, mechanism_->boresight_body(), 3, [&](double t) {
    return gain_of_displacement(*mechanism_, ideal, quantity_, std::min(t, mechanism_->duration()));
  });
  cache_->errors = std::make_shared<const ErrorsOverTime>(ErrorsOverTime{
      influence, std::move(columns), StandingCurvature(*mechanism_, ideal, *influence, quantity_, typical_errors_)});
  cache_->errors_scene = scene;
  return cache_->errors;
}

// The jobs of some samples, and what they point to.
struct PerturbationLanes::Batch {
  std::vector<std::shared_ptr<const Prepared>> prepared;
  std::list<std::vector<JointPlay>> joints;
  std::list<std::vector<double>> tolerances;
  std::list<VecX> starts;
  std::list<std::vector<double>> standing;
  VecX values;  // of the errors at the knots, while they are contracted
  std::vector<LaneJob> jobs;
  double bytes = 0.0;  // of scenes that only this batch needs, at most, and of courses

  // values: knots x count, row by row.
  LaneCourses courses(int count, double spacing, const std::vector<double>& values_at) {
    const int knots_of = static_cast<int>(values_at.size()) / count;
    std::vector<double>& knots = standing.emplace_back(2 * values_at.size());
    bytes += static_cast<double>(knots.size() * sizeof(double));
    for (int k = 0; k < knots_of; ++k)
      for (int i = 0; i < count; ++i) {
        const auto value = [&](int j) { return values_at[static_cast<std::size_t>(j * count + i)]; };
        const auto at = static_cast<std::size_t>(2 * k * count + i);
        knots[at] = value(k);
        knots[at + static_cast<std::size_t>(count)] = TimeTable::slope_at_knot(k, knots_of, value);
      }
    return {.knots = knots.data(), .cells = knots_of - 1, .per_spacing = 1.0 / spacing};
  }
};

void PerturbationLanes::add(const Parameters& sample, double tolerance, Batch& to) const {
  if (to.prepared.empty() || !same_scene(to.prepared.back()->parameters, sample)) {
    to.prepared.push_back(prepared_for(sample));
    to.bytes += to.prepared.back()->bytes();
  }
  const Prepared& p = *to.prepared.back();
  const SceneLayout& at = p.tables->layout;
  const std::vector<JointPlay>& own = to.joints.emplace_back(joint_plays(mechanism_->description(), sample));
  // Scale of each coordinate: of an offset its clearance, of a slope the slope that crosses it.
  VecX scale = VecX::Zero(at.n);
  std::vector<double> gap;
  for (int c = 0; c < mechanism_->clearances(); ++c) {
    const JointPlay& law = own[c];
    const double clearance = law.narrowest();
    gap.push_back(kGapShare * tolerance * clearance);
    for (int k = 0; k < at.joints[c].offsets; ++k) {
      const int source = at.joints[c].source[k];
      if (source < 0) continue;
      const double own_scale = k < 3 ? clearance : clearance / law.lever();
      scale[source] = scale[source] == 0.0 ? own_scale : std::min(scale[source], own_scale);
    }
  }
  for (int k = 0; k < at.n; ++k)
    if (scale[k] == 0.0) scale[k] = scale.maxCoeff() > 0.0 ? scale.maxCoeff() : 1e-4;
  auto& errors = to.tolerances.emplace_back();
  for (int k = 0; k < at.n; ++k) errors.push_back(tolerance * scale[k]);
  // Of a rate: what leads to that error of the offset in the time in which the scene throws the coordinate across its clearance. Where
  // several joints strike no flight is left alone for longer than the quickest one's.
  const VecX crossing = (p.acceleration.array() / scale.array()).sqrt();
  const double quickest = std::max(crossing.maxCoeff() * (mechanism_->clearances() > 1 ? 1.0 : kSlowestCrossing),
                                   1.0 / mechanism_->duration());  // where nothing loads them
  for (int k = 0; k < at.n; ++k) errors.push_back(tolerance * scale[k] * std::max(crossing[k], quickest));
  errors.insert(errors.end(), gap.begin(), gap.end());
  to.jobs.push_back({.scene = &p.lane,
                     .joints = own.data(),
                     .tolerance = errors.data(),
                     .start = nullptr,
                     .gap_tolerance = errors.data() + 2 * at.n,
                     .standing = {}});
  SceneStart start = p.tables->start;
  if (has_errors(sample)) add_errors(sample, p, start, to);
  std::string warning;  // the rung itself says it
  to.starts.push_back(start_coordinates(*mechanism_, at, start, own, warning));
  to.jobs.back().start = to.starts.back().data();
}

void PerturbationLanes::add_errors(const Parameters& sample, const Prepared& prepared, SceneStart& start,
                                   Batch& to) const {
  const std::shared_ptr<const ErrorsOverTime> errors = errors_for(prepared.scene);
  errors->influence->require(sample.error);
  const StandingDisplacement standing(errors->influence, sample.error);
  if (standing.shifts())
    throw ComputationError(
        "an error takes up play of redundant joints, which the perturbation rung follows and lanes do not");
  const StandingColumns& columns = errors->columns;
  columns.contract(sample.error, to.values);
  LaneStanding& own = to.jobs.back().standing;
  own.index = to.courses(3, columns.spacing, {to.values.begin(), to.values.end()});
  own.longest_step = kCellsOfErrors * columns.spacing;
  const StandingLoads::Change change = prepared.lane.form == SceneForm::accelerations
                                           ? prepared.scene->changed_accelerations(sample, standing, *prepared.tables)
                                           : prepared.scene->changed_loads(sample, standing);
  if (change.values.empty()) return;
  const SceneLayout& at = prepared.tables->layout;
  // Journals start where these loads have them rest, too.
  VecX more = Eigen::Map<const VecX>(change.values.data(), at.n);
  if (prepared.lane.form == SceneForm::forces) {
    MatX A;
    at.inverse_mass(start.row.data(), A);
    more = (A * more).eval();
  }
  Eigen::Map<VecX>(&start.row[static_cast<std::size_t>(at.Ar)], at.n) += more;
  own.loads = to.courses(at.n, change.spacing, change.values);
  own.longest_step = std::min(own.longest_step, kCellsOfLoads * change.spacing);
}

double PerturbationLanes::error_of_linearity(const Parameters& sample, double index) const {
  if (!has_errors(sample)) return 0.0;
  return errors_for(prepared_for(sample)->scene)->curvature.error(sample.error, index);
}

void PerturbationLanes::run(const LaneTarget& target, std::span<const Parameters> samples,
                            std::span<LaneOutcome> outcomes, double tolerance, const LaneWatch& watch) const {
  struct Listener {
    const LaneWatch& watch;
    std::size_t first = 0;              // sample of the batch
    double before = 0.0, latest = 0.0;  // attempts, of earlier batches and in all
  } listener{watch};
  LaneSettings settings;
  settings.method = &rodas4();
  settings.start = start_;
  // Across a step the scene's numbers are straight lines: a hundredth of the time in which they turn.
  settings.longest_step = std::min({settings.longest_step, mechanism_->duration() / 100.0, longest_step_});
  settings.longest_held_step =
      std::min(settings.longest_step, kHeldShare * settings.longest_step * std::sqrt(tolerance / kLaneTolerance));
  settings.stop = watch.stop;
  settings.listener = &listener;
  settings.ended = [](void* to, long job, double attempts) {
    Listener& l = *static_cast<Listener*>(to);
    l.latest = l.before + attempts;
    if (l.watch.ended) l.watch.ended(l.first + static_cast<std::size_t>(job), l.latest);
  };

  auto batch = std::make_unique<Batch>();
  const auto flush = [&] {
    if (watch.prepared) watch.prepared(batch->jobs.size(), listener.latest);
    target.kernel(batch->jobs.data(), static_cast<long>(batch->jobs.size()), settings, &outcomes[listener.first]);
    listener.first += batch->jobs.size();
    listener.before = listener.latest;
    batch = std::make_unique<Batch>();
  };
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (watch.stop != nullptr && watch.stop->load(std::memory_order_relaxed)) {
      for (std::size_t i = listener.first; i < samples.size(); ++i) outcomes[i].status = LaneStatus::not_reached;
      return;
    }
    if (k == 0 && prepared_for(samples[0])->tables->layout.n == 0) {  // of one sample as of all: no play can move
      if (std::any_of(samples.begin(), samples.end(), has_errors))
        throw ComputationError("no play can move: samples of errors alone are GeometricErrors' to answer");
      std::fill(outcomes.begin(), outcomes.end(), LaneOutcome{.t = mechanism_->duration()});
      if (watch.prepared) watch.prepared(samples.size(), 0.0);
      for (std::size_t i = 0; watch.ended && i < samples.size(); ++i) watch.ended(i, 0.0);
      return;
    }
    // One call is of one layout: loads that tip journals over have a stiffness of their own.
    if (!batch->jobs.empty() && !same_scene(batch->prepared.back()->parameters, samples[k])) {
      const std::shared_ptr<const Prepared> next = prepared_for(samples[k]);
      const LaneScene &before = batch->prepared.back()->lane, &now = next->lane;
      if (before.width != now.width || before.layout->tips != now.layout->tips) flush();
    }
    add(samples[k], tolerance, *batch);
    if (batch->bytes > kMostBytesHeld) flush();
  }
  if (!batch->jobs.empty()) flush();
}

}  // namespace boresight
