#include "boresight/statics/reaction_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/mechanism/load_time.hpp"
#include "boresight/play/play_words.hpp"
#include "boresight/scene/acting_loads.hpp"
#include "boresight/stepping/steps_of_errors.hpp"

namespace boresight {
namespace {

// Instants at most so far apart [s], and at least so many along the motion: the reaction's direction may turn fast.
constexpr double kSpacing = 5e-4;
constexpr int kFewestInstants = 400;
// More than so many only as far as the scene is tabled that finely.
constexpr int kManyInstants = 200000, kInstantsPerKnot = 4;
// Knots of the ideal motion's own table between two instants: a quarter of a radian of what is fastest in it.
constexpr double kKnotsOfInstant = 4.0;
// Share of the offsets that counts as none.
constexpr double kNothing = 1e-6;
// Of the largest load: its direction is then known to two thousandths of a radian.
constexpr double kDecides = 500.0 * ClearanceScene::kAccuracy;
// Of a load: its force, and its couple as forces at the sleeve's ends [N].
double size(const PlayOffsets& load, const JointPlay& joint) {
  const double couple = load.tail<3>().norm();
  return load.head<3>().norm() + (couple > 0.0 ? couple / joint.lever() : 0.0);
}

constexpr int kLooks = 41;  // along a motion, for the size of what acts

// The largest sum of what acts on the bodies along the motion [N].
double acting_forces(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal) {
  double largest = 0.0;
  std::vector<BodyMotion> bodies(mechanism.bodies());
  std::vector<BodyAcceleration> accelerations(mechanism.bodies());
  for (int i = 0; i < kLooks; ++i) {
    const double t = mechanism.duration() * i / (kLooks - 1);
    for (int b = 0; b < mechanism.bodies(); ++b) bodies[b] = ideal.body(t, b, &accelerations[b]);
    largest = std::max(largest, sum_of_acting_loads(mechanism, parameters, t, bodies, accelerations));
  }
  return largest;
}

// What the bodies weigh and resist on each coordinate where it is largest [N, N m]. Each body is taken to be accelerated as the fastest of
// them is: an acceleration is known as well as the largest is, whatever its own.
VecX weight_and_inertia_on_coordinates(const Mechanism& mechanism, const PreparedScene& prepared,
                                       const Parameters& parameters) {
  const ClearanceScene& scene = prepared.scene();
  const std::vector<MassProperties> masses = mechanism.mass_properties(parameters);
  const int bodies = mechanism.bodies(), stride = std::max(1, (scene.knots() - 1) / (kLooks - 1));
  double linear = 0.0, angular = 0.0;
  for (int k = 0; k < scene.knots(); k += stride)
    for (int b = 0; b < bodies; ++b) {
      BodyAcceleration acceleration;
      const BodyMotion motion = prepared.ideal().body(k * scene.spacing(), b, &acceleration);
      linear = std::max(linear, acceleration.head<3>().norm());
      angular = std::max(angular, acceleration.tail<3>().norm() + motion.w.squaredNorm());
    }
  VecX largest = VecX::Zero(scene.layout().n);
  for (int k = 0; k < scene.knots(); k += stride) {
    VecX sum = VecX::Zero(largest.size());
    for (int b = 0; b < bodies; ++b)
      add_to_coordinates(weight_and_inertia(masses[b], parameters.gravity.norm(), linear, angular), b,
                         scene.pose_gains_at(k), sum);
    largest = largest.cwiseMax(sum);
  }
  return largest;
}

}  // namespace

namespace {

constexpr const char* kTabling = "tabling the ideal joints' reactions";

// What a spring does hangs on where journals lie.
bool held_by_springs(const Parameters& parameters) {
  return std::any_of(parameters.spring.begin(), parameters.spring.end(),
                     [](const SpringParameters& s) { return s.stiffness > 0.0; });
}

}  // namespace

ReactionTable::ReactionTable(const Mechanism& mechanism, const PreparedScene& prepared,
                             const StandingDisplacement& standing, const Parameters& parameters, double share)
    : mechanism_(mechanism),
      layout_(prepared.scene().layout()),
      tied_(standing.shifts() || layout_.tips || held_by_springs(parameters)) {
  const ClearanceScene& scene = prepared.scene();
  if (scene.coordinates().leftover() > 0)
    throw ComputationError(parts_in_play(mechanism.description()).inserts +
                           " come to rest only where every freedom of the ideal mechanism is driven; use perturbation");
  // A motion of hours moves more slowly: its own table says how fast.
  const double wanted = std::max<double>(
      kFewestInstants,
      std::min(mechanism.duration() / kSpacing, std::max<double>(kManyInstants, kInstantsPerKnot * scene.knots())));
  // Whatever the knots of the scene: how fine these are may be decided by rounding.
  const double of_loads =
      mechanism.duration() /
      (kCellOfLoads * std::min(prepared.load_time(), time_of_errors(mechanism, prepared.error_times(), parameters)));
  const double of_motion = (prepared.ideal().knots() - 1.0) / kKnotsOfInstant;
  instants_ = static_cast<int>(std::ceil(std::max({wanted, of_loads, of_motion}) / share)) + 1;
  spacing_ = mechanism.duration() / (instants_ - 1);
  const std::shared_ptr<const SceneTables> tables = prepared.tables(parameters);
  change_ = prepared.changed_loads(parameters, standing).table(layout_.n);
  const int n = layout_.n, width = 7 * n + (3 + n) * mechanism.clearances();
  joints_ = joint_plays(mechanism.description(), parameters);
  for (const JointPlay& joint : joints_) groups_.push_back(joint.pushed_together());
  // Across its axis, or in tilt, a journal that is free in one direction alone is tied in most others, and so is a ball: which of them are
  // offsets is a matter of how the mechanism lies in space.
  for (std::size_t c = 0; c < joints_.size(); ++c)
    for (const std::vector<int>& group : groups_[c]) {
      const SceneLayout::Joint& joint = layout_.joints[c];
      if (group.empty() || group.front() >= joint.offsets) continue;
      const auto tied = [&](int k) { return joint.source[k] == DeviationCoordinates::kDependent; };
      const auto count = std::count_if(group.begin(), group.end(), tied);
      tied_ = tied_ || (count > 0 && count < static_cast<long>(group.size()));
    }
  std::vector<double> values, row(layout_.width);
  MatX M, C;
  VecX r;
  for (int k = 0; k < scene.knots(); ++k) {
    work_reached(kTabling, 0.5 * k / scene.knots());
    const MatX& B = scene.offsets_per_coordinate(k);
    for (int c = 0; c < mechanism.clearances(); ++c)
      for (int i = 0; i < layout_.joints[c].offsets; ++i)
        if (layout_.joints[c].source[i] == DeviationCoordinates::kDependent &&
            B.row(scene.offsets().joint(c).first + i).cwiseAbs().maxCoeff() > kNothing)
          tied_ = true;
    scene.assemble(parameters, k, M, C, r);
    values.insert(values.end(), r.data(), r.data() + n);
    const MatX E = scene.pose_gain_at(k);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < n; ++j) values.push_back(E(i, j));
    tables->dynamics.at(k * scene.spacing(), row.data());
    for (const SceneLayout::Joint& j : layout_.joints) {
      slides_ = slides_ || j.slides == 1;
      values.push_back(j.slides == 1 ? row[j.slide] : 0.0);
      for (int i = 0; i < n; ++i) values.push_back(j.slides == 1 ? row[j.slide_gain + i] : 0.0);
      for (int i = 0; i < 2; ++i) values.push_back(j.twists ? row[j.twist + i] : 1.0 - i);
    }
  }
  table_ = EightPointTable(scene.spacing(), width, std::move(values));
  cancelled_ = kCancelledLoad * acting_forces(mechanism, parameters, prepared.ideal());
  for (std::size_t c = 0; c < joints_.size(); ++c) {
    std::vector<double>& least = least_.emplace_back();
    for (const std::vector<int>& group : groups_[c])
      least.push_back(cancelled_ * (group.empty() || group.front() < 3 ? 1.0 : joints_[c].lever()));
  }
  largest_load_.assign(joints_.size(), 0.0);
  for (int i = 0; i < instants_; ++i) {
    work_reached(kTabling, 0.5 + 0.5 * i / instants_);
    const Instant now = at(i);
    for (std::size_t c = 0; c < joints_.size(); ++c)
      largest_load_[c] = std::max(largest_load_[c], size(now.load[c].force, joints_[c]));
  }
  find_least_loads(prepared, parameters);
}

// Beside what carries a journal, along its axis and in tilt, next to nothing would push it all the way that its play leaves; and where
// nothing carries any, so would what rounding leaves.
void ReactionTable::find_least_loads(const PreparedScene& prepared, const Parameters& parameters) {
  if (joints_.empty()) return;
  const double largest = *std::max_element(largest_load_.begin(), largest_load_.end());
  const VecX acting = weight_and_inertia_on_coordinates(mechanism_, prepared, parameters);
  for (std::size_t c = 0; c < joints_.size(); ++c)
    for (std::size_t g = 1; g < groups_[c].size(); ++g) {
      double own = 0.0;
      for (const int k : groups_[c][g]) {
        const int source =
            k < layout_.joints[c].offsets ? layout_.joints[c].source[k] : DeviationCoordinates::kDependent;
        if (source >= 0) own = std::hypot(own, acting[source]);
      }
      const bool turns = !groups_[c][g].empty() && groups_[c][g].front() >= 3;
      least_[c][g] = std::max(least_[c][g], kRounding * std::min(own, largest * (turns ? joints_[c].lever() : 1.0)));
    }
}

bool ReactionTable::decides(const Instant& instant, int clearance) const {
  return size(instant.load[clearance].force, joints_[clearance]) > kDecides * largest_load_[clearance];
}

ReactionTable::Instant ReactionTable::at_time(double t) const {
  const int n = layout_.n;
  std::vector<double> row(7 * n + (3 + n) * joints_.size());
  Instant now;
  now.t = t;
  table_.at(now.t, row.data());
  if (change_.width() > 0) change_.add(now.t, row.data());
  now.reaction = Eigen::Map<const VecX>(row.data(), n);
  now.pose_gain = Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>>(row.data() + n, 6, n);
  for (std::size_t c = 0; c < joints_.size(); ++c) {
    const double* slide = row.data() + 7 * n + (3 + n) * c;
    const Vec2T<double> twist(slide[n + 1], slide[n + 2]);
    Load load{PlayOffsets::Zero(),
              layout_.joints[c].slides == 1,
              {*slide, twist.normalized()},
              Eigen::Map<const VecX>(slide + 1, n)};
    for (int k = 0; k < layout_.joints[c].offsets; ++k)
      if (const int source = layout_.joints[c].source[k]; source >= 0) load.force[k] = now.reaction[source];
    for (std::size_t g = 0; g < groups_[c].size(); ++g)
      if (const std::vector<int>& group = groups_[c][g]; !group.empty() && load.force(group).norm() < least_[c][g])
        load.force(group).setZero();
    now.load.push_back(load);
  }
  return now;
}

Eigen::Matrix<double, 6, kMostOffsets> ReactionTable::joint_gain(const Instant& instant, int clearance) const {
  Eigen::Matrix<double, 6, kMostOffsets> gain = Eigen::Matrix<double, 6, kMostOffsets>::Zero();
  const SceneLayout::Joint& joint = layout_.joints[clearance];
  for (int k = 0; k < joint.offsets; ++k)
    if (joint.source[k] >= 0) gain.col(k) = instant.pose_gain.col(joint.source[k]);
  return gain;
}

VecX ReactionTable::coordinates(const std::vector<RestingPlay>& rest) const {
  VecX z = VecX::Zero(layout_.n);
  for (std::size_t c = 0; c < rest.size(); ++c) {
    const PlayOffsets offset = offsets_of(rest[c].motion);
    for (int k = 0; k < layout_.joints[c].offsets; ++k)
      if (const int source = layout_.joints[c].source[k]; source >= 0) z[source] = offset[k];
  }
  return z;
}

const std::string& ReactionTable::joint_name(int clearance) const {
  const MechanismDescription& description = mechanism_.description();
  return description.joints[description.clearances[clearance].joint].name;
}

}  // namespace boresight
