#include "boresight/mechanism/ideal_motion.hpp"

#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "boresight/mechanism/continuation.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/error_course.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/mechanism/motion_density.hpp"
#include "boresight/mechanism/rank_analysis.hpp"

namespace boresight {
namespace {

std::string time_text(double t) {
  char text[40];
  std::snprintf(text, sizeof text, "t = %.6g s", t);
  return text;
}

// Largest difference between the interpolated and an exact state, in characteristic lengths and radians.
double interpolation_error(const IdealMotion& motion, const IdealState& exact, double length) {
  double worst = 0.0;
  for (std::size_t b = 0; b < exact.bodies.size(); ++b) {
    const BodyMotion m = motion.body(exact.t, static_cast<int>(b));
    worst = std::max({worst, (m.p - exact.bodies[b].p).norm() / length, (m.R - exact.bodies[b].R).norm()});
  }
  return worst;
}

// The prescribed laws alone, which cost nothing to look at: whether what they do between two times shows at these times. A slew of a
// second in an hour at rest is seen here, where it would fall between two states.
class Laws {
 public:
  explicit Laws(const Mechanism& mechanism) : length_(mechanism.characteristic_length()) {
    const MechanismDescription& m = mechanism.description();
    for (const auto& [joint, law] : m.motion.drives)
      laws_.push_back({law, m.joints[joint].type == JointType::prismatic ? length_ : 1.0});
    if (!m.motion.pose) return;
    for (int k = 0; k < 3; ++k) {
      laws_.push_back({m.motion.pose->angle[k], 1.0});
      laws_.push_back({m.motion.pose->position[k], length_});
    }
  }

  // missed: [rad, or characteristic lengths]
  bool interpolable(double t0, double t1, int looks, double missed) const {
    for (const Law& law : laws_) {
      const TimeValue a = law.function->at(t0), b = law.function->at(t1);
      const QuinticSpline curve(t0, t1 - t0, 1, {a.value, b.value}, {a.rate, b.rate}, {a.acceleration, b.acceleration});
      for (int i = 1; i <= looks; ++i) {
        const double t = t0 + (t1 - t0) * i / (looks + 1);
        const double value = law.function->at(t).value;
        if (std::abs(curve.at(t, 0).value - value) > missed * law.scale + 1e-12 * std::abs(value)) return false;
      }
    }
    return true;
  }

 private:
  struct Law {
    TimeFunctionPtr function;
    double scale;
  };
  double length_;
  std::vector<Law> laws_;
};

// How finely a motion is tabled. What moves decides: the number of intervals is doubled until quintics between the states meet the
// motion. Up to kUsual intervals to 1e-12, which smooth motions of up to a thousand turns reach; from there on to 1e-9, where the
// rounding of angles grown to millions lies. What would take more states than memory should hold is refused.
constexpr int kFewestIntervals = 128, kUsual = 1 << 15, kMostIntervals = 1 << 24;
constexpr double kTolerance = 1e-12, kLongMotionsTolerance = 1e-9, kLawsTolerance = 1e-6, kLargestKink = 1e-3;
constexpr int kLooksAtLaws = 20000, kMostSubsteps = 256;

// Poses, rates and accelerations while they are found, the values that are fitted, and the coefficients.
double bytes_of_state(int bodies) {
  return bodies * (sizeof(BodyMotion) + sizeof(BodyAcceleration) + (7.0 * 3.0 + 7.0 * 6.0) * 8.0);
}

[[noreturn]] void refuse_density(const Mechanism& mechanism, double t, double spacing) {
  const double states = mechanism.duration() / spacing;
  char text[400];
  std::snprintf(text, sizeof text,
                "the ideal motion of %.6g s moves so fast at %s that it takes %.2g states or more to describe, %.2g GB "
                "of memory; shorten "
                "motion.duration to what has to be seen, a few periods",
                mechanism.duration(), time_text(t).c_str(), states, 1e-9 * states * bytes_of_state(mechanism.bodies()));
  throw MotionTooDense(text);
}

}  // namespace

IdealMotion IdealMotion::kinematic(const Mechanism& mechanism) {
  const double T = mechanism.duration();
  const bool read_drives = mechanism.description().motion.pose.has_value();
  const Laws laws(mechanism);
  // Far from the world's origin poses are closed to fewer digits, which no finer grid brings back: it makes accelerations of them.
  double farthest = 0.0;
  for (const BodyDescription& body : mechanism.description().bodies)
    farthest = std::max(farthest, body.center_of_mass.lpNorm<Eigen::Infinity>());
  const double rounding = 32.0 * std::numeric_limits<double>::epsilon() * farthest / mechanism.characteristic_length();
  int most = kUsual;
  while (2 * most <= kMostIntervals && 2.0 * most * bytes_of_state(mechanism.bodies()) < kMostTableBytes) most *= 2;
  for (int intervals = kFewestIntervals;; intervals *= 2) {
    const double spacing = T / intervals,
                 tolerance = std::max(rounding, intervals < kUsual ? kTolerance : kLongMotionsTolerance);
    IdealSolver solver(mechanism);
    IdealState state;
    solver.start(state);
    std::vector<IdealState> knots{state};
    const auto piece_error = [&](const IdealState& first, const IdealState& between, const IdealState& second) {
      return interpolation_error(IdealMotion(mechanism, {first, second}, 0.0, read_drives), between,
                                 mechanism.characteristic_length());
    };
    // A law with a kink (abs) has no sixth derivative for a finer grid to gain by: halves miss it nearly as much as the whole.
    const auto kinked = [&](const IdealState& first, const IdealState& between, const IdealState& second, double miss) {
      IdealState early = first, late = between;
      if (!solver.solve(0.5 * (first.t + between.t), early) || !solver.solve(0.5 * (between.t + second.t), late))
        return false;
      return std::max(piece_error(first, early, between), piece_error(between, late, second)) > miss / 16.0;
    };
    // The first gap where the grid is seen to be too coarse ends it: quintics hang on the two states at their ends alone.
    double coarse_at = -1.0, step = spacing, worst = 0.0;
    for (int k = 1; k <= intervals && coarse_at < 0.0; ++k) {
      const double from = state.t, to = k * T / intervals;
      const bool checked = k % 16 == 0;
      IdealState middle;
      // Every 16th gap is also solved at its middle, to see what interpolation loses there.
      bool led = true;
      if (checked) {
        led = follow(solver, (k - 0.5) * T / intervals, state, mechanism, kMostSubsteps, step);
        middle = state;
      }
      led = led && follow(solver, to, state, mechanism, kMostSubsteps, step);
      if (!led) {
        coarse_at = state.t;
        while (2.0 * step < T / intervals && intervals <= most) intervals *= 2;  // as far as doubling would lead
        if (intervals > most) refuse_density(mechanism, state.t, step);
        break;
      }
      knots.push_back(state);
      bool fine = laws.interpolable(from, to, std::max(3, kLooksAtLaws / intervals),
                                    intervals < kUsual ? kLawsTolerance : kLargestKink);
      if (checked && fine) {
        const double miss = piece_error(knots[k - 1], middle, knots[k]);
        worst = std::max(worst, miss);
        fine = miss < tolerance ||
               (intervals >= kUsual && miss < kLargestKink && kinked(knots[k - 1], middle, knots[k], miss));
      }
      if (!fine) coarse_at = from;
    }
    if (coarse_at < 0.0) {
      IdealMotion motion(mechanism, knots, worst, read_drives);
      // A built mechanism's motion is nearly that of the drawn one, which is looked at once for all of them.
      if (!mechanism.built()) motion.lost_ = lost_motions(mechanism, motion);
      if (!mechanism.built() && read_drives) require_laws_along(mechanism, motion);
      return motion;
    }
    if (2 * intervals > most) refuse_density(mechanism, coarse_at, 0.5 * spacing);
  }
}

IdealMotion::IdealMotion(const Mechanism& mechanism, const std::vector<IdealState>& knots, double error)
    : IdealMotion(mechanism, knots, error, false) {}

IdealMotion::IdealMotion(const Mechanism& mechanism, const std::vector<IdealState>& knots, double error,
                         bool read_drives)
    : error_(error) {
  fit(mechanism, knots, read_drives);
}

void IdealMotion::fit(const Mechanism& mechanism, const std::vector<IdealState>& knots, bool read_drives) {
  bodies_ = mechanism.bodies();
  knots_ = static_cast<int>(knots.size());
  duration_ = knots.back().t - knots.front().t;
  const double spacing = duration_ / (knots_ - 1);
  // Times that are not those of a grid to rounding; the grid's arithmetic is the faster one.
  std::vector<double> times;
  for (int k = 0; k < knots_ && times.empty(); ++k)
    if (std::abs(knots[k].t - knots.front().t - k * spacing) > 1e-6 * spacing)
      for (const IdealState& s : knots) times.push_back(s.t);
  const auto spline = [&](int width, const std::vector<double>& value, const std::vector<double>& rate,
                          const std::vector<double>& acceleration) {
    return times.empty() ? QuinticSpline(knots.front().t, spacing, width, value, rate, acceleration)
                         : QuinticSpline(times, width, value, rate, acceleration);
  };
  const int width = 7 * bodies_;
  std::vector<double> value, rate, acceleration;
  for (std::vector<double>* all : {&value, &rate, &acceleration})
    all->reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(knots_));
  std::vector<Quat> last(bodies_, Quat::Identity());
  constexpr int kMany = 4096;  // fewer take no time, and pieces of a motion are fitted while it is followed
  for (const IdealState& s : knots) {
    if (knots_ > kMany) work_reached("tabling the ideal motion", (s.t - knots.front().t) / duration_);
    for (int b = 0; b < bodies_; ++b) {
      const BodyMotion& body = s.bodies[b];
      Quat q(body.R);
      if (q.dot(last[b]) < 0.0) q.coeffs() *= -1.0;  // the same rotation, on the side that continues the curve
      last[b] = q;
      // qdot = w q / 2 and qddot = alpha q / 2 - |w|^2 q / 4, with w, alpha as pure quaternions in world axes.
      const Vec3 alpha = s.acceleration[b].tail<3>();
      const Quat wq = Quat(0.0, body.w.x(), body.w.y(), body.w.z()) * q;
      const Quat aq = Quat(0.0, alpha.x(), alpha.y(), alpha.z()) * q;
      for (int k = 0; k < 3; ++k) {
        value.push_back(body.p[k]);
        rate.push_back(body.v[k]);
        acceleration.push_back(s.acceleration[b][k]);
      }
      const Eigen::Vector4d q0(q.w(), q.x(), q.y(), q.z());
      const Eigen::Vector4d q1 = 0.5 * Eigen::Vector4d(wq.w(), wq.x(), wq.y(), wq.z());
      const Eigen::Vector4d q2 =
          0.5 * Eigen::Vector4d(aq.w(), aq.x(), aq.y(), aq.z()) - 0.25 * body.w.squaredNorm() * q0;
      for (int k = 0; k < 4; ++k) {
        value.push_back(q0[k]);
        rate.push_back(q1[k]);
        acceleration.push_back(q2[k]);
      }
    }
  }
  bodies_spline_ = spline(width, value, rate, acceleration);

  for (int j = 0; j < mechanism.joints(); ++j)
    if (mechanism.description().joints[j].driven) driven_.push_back(j);
  if (!read_drives) {
    for (int j : driven_) {
      const auto law = mechanism.description().motion.drives.find(j);
      drive_law_.push_back(law == mechanism.description().motion.drives.end() ? std::make_shared<ConstantFunction>(0.0)
                                                                              : law->second);
    }
    return;
  }
  const int drives = static_cast<int>(driven_.size());
  value.clear(), rate.clear(), acceleration.clear();
  for (const IdealState& s : knots) {
    for (int k = 0; k < drives; ++k) {
      TimeValue x = joint_coordinate(mechanism, driven_[k], s.bodies, &s.acceleration);
      if (!value.empty() && static_cast<int>(value.size()) >= drives &&
          mechanism.description().joints[driven_[k]].type == JointType::revolute) {
        const double before = value[value.size() - drives];
        x.value += 2.0 * std::numbers::pi * std::round((before - x.value) / (2.0 * std::numbers::pi));
      }
      value.push_back(x.value);
      rate.push_back(x.rate);
      acceleration.push_back(x.acceleration);
    }
  }
  if (drives > 0) drive_spline_ = spline(drives, value, rate, acceleration);
}

void IdealMotion::drive_laws(double t, std::vector<TimeValue>& laws) const {
  for (std::size_t k = 0; k < driven_.size(); ++k)
    laws[driven_[k]] = drive_law_.empty() ? drive_spline_.at(t, static_cast<int>(k)) : drive_law_[k]->at(t);
}

TimeValue IdealMotion::drive_law(double t, int joint) const {
  for (std::size_t k = 0; k < driven_.size(); ++k)
    if (driven_[k] == joint)
      return drive_law_.empty() ? drive_spline_.at(t, static_cast<int>(k)) : drive_law_[k]->at(t);
  return {};
}

BodyMotion IdealMotion::body(double t, int body, BodyAcceleration* acceleration) const {
  TimeValue x[7];
  bodies_spline_.at(t, 7 * body, 7, x);
  BodyMotion m;
  m.p = Vec3(x[0].value, x[1].value, x[2].value);
  m.v = Vec3(x[0].rate, x[1].rate, x[2].rate);
  const Quat q(x[3].value, x[4].value, x[5].value, x[6].value);
  const Quat q1(x[3].rate, x[4].rate, x[5].rate, x[6].rate);
  m.R = q.normalized().toRotationMatrix();
  m.w = 2.0 * (q1 * q.conjugate()).vec();
  if (acceleration) {
    const Quat q2(x[3].acceleration, x[4].acceleration, x[5].acceleration, x[6].acceleration);
    acceleration->head<3>() = Vec3(x[0].acceleration, x[1].acceleration, x[2].acceleration);
    acceleration->tail<3>() = 2.0 * (q2 * q.conjugate()).vec();
  }
  return m;
}

void IdealMotion::state(double t, IdealState& state) const {
  state.t = t;
  state.bodies.resize(bodies_);
  state.acceleration.resize(bodies_);
  for (int b = 0; b < bodies_; ++b) state.bodies[b] = body(t, b, &state.acceleration[b]);
}

}  // namespace boresight
