#include "boresight/rungs/perturbation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "boresight/integrate/explicit_runge_kutta.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/contact_tracker.hpp"
#include "boresight/rungs/motion_recorder.hpp"
#include "boresight/rungs/step_error.hpp"
#include "boresight/rungs/offset_dynamics.hpp"
#include "boresight/rungs/contact_report.hpp"
#include "boresight/rungs/scene_rung.hpp"
#include "boresight/rungs/unstable_step.hpp"

namespace boresight {
namespace {

// What is left out is of second order in the deviation: relative to what is kept, the deviation over the mechanism's size
// (turns in rad, displacements over the characteristic length), times how much the mechanism magnifies its offsets.
struct Nonlinearity {
  double deviation = 0.0;  // largest, over the characteristic length or in rad
  double offset = 0.0;     // largest, of any coordinate
  void add(const PoseError& error, const Eigen::Ref<const VecX>& z, double length) {
    deviation = std::max({deviation, error.position / length, error.orientation});
    offset = std::max(offset, z.lpNorm<Eigen::Infinity>());
  }
  double share(double length) const {
    return offset > 0.0 ? deviation * std::max(1.0, deviation * length / offset) : 0.0;
  }
};

class Perturbation final : public SceneRung {
 public:
  explicit Perturbation(std::shared_ptr<const Mechanism> mechanism) : SceneRung(std::move(mechanism)) {}

  std::string name() const override { return "perturbation"; }
  std::string leaves_out() const override {
    return "The deviation from the ideal motion is linear in the joint offsets: how the pose, the masses and the reactions "
           "change with the offset itself is left out, which grows with clearance over link length and near singular poses.";
  }

 private:
  RunResult follow(const PreparedScene& prepared, const Parameters& parameters, const RunOptions& options) const override {
    const double own = options.step > 0.0 ? options.step : own_step(prepared, parameters);
    return with_stable_step(options.step, own, options.sample_spacing,
                            [&](double step) { return integrate(prepared, parameters, options, step); });
  }

  // Share of the stable step of the joints' contacts taken together, at twice the largest ideal reaction: what a load
  // suddenly applied to an elastic contact reaches.
  double own_step(const PreparedScene& prepared, const Parameters& parameters) const {
    double step = std::min(kPaperStep, mechanism().duration() / 100.0);
    for (const ContactFrequency& c : analyse_contacts(mechanism(), parameters, prepared.ideal()))
      if (c.largest_stable_step > 0.0) step = std::min(step, kShareOfStableStep * c.largest_stable_step);
    return step;
  }

  RunResult integrate(const PreparedScene& prepared, const Parameters& parameters, const RunOptions& options,
                      double wanted) const {
    const Mechanism& mechanism = this->mechanism();
    const MechanismDescription& m = mechanism.description();
    const std::shared_ptr<const SceneTables> tables = prepared.tables(parameters);
    const SceneLayout& at = tables->layout;
    const OffsetLayout& offsets = prepared.scene().offsets();
    const int n = at.n;
    const double duration = mechanism.duration();

    std::vector<JournalInSleeve> joints;
    std::vector<ContactTracker> trackers;
    for (int c = 0; c < mechanism.clearances(); ++c) {
      const JointDescription& joint = m.joints[m.clearances[c].joint];
      joints.emplace_back(m.clearances[c], joint.type, parameters.clearance[c]);
      trackers.emplace_back(c, joint.name, joints.back(), options.events);
    }
    std::vector<ContactMemory> memory(joints.size());
    std::vector<JournalMotion<double>> motion(joints.size());
    std::vector<JournalWrench<double>> wrench(joints.size());
    std::vector<double> row(tables->dynamics.width());
    VecX force(n);
    double scene_time = -1.0;
    const auto scene_at = [&](double t) {
      if (t == scene_time) return;  // two stages of a step share their time, and so do a step's end and the next one's start
      tables->dynamics.at(t, row.data());
      scene_time = t;
    };
    const auto derivative = [&](double t, const VecX& y, VecX& dy) {
      scene_at(t);
      const double *z = y.data(), *rate = z + n;
      force.setZero();
      for (std::size_t c = 0; c < joints.size(); ++c) {
        motion[c] = journal_motion(at, at.joints[c], row.data(), z, rate);
        joints[c].wrench(motion[c], memory[c].impact_speed, wrench[c]);
        add_generalised_force(at, at.joints[c], row.data(), motion[c], wrench[c], force.data());
      }
      std::copy(rate, rate + n, dy.data());
      coordinate_acceleration(at, row.data(), z, rate, force.data(), dy.data() + n);
    };

    const long steps = std::max(1L, static_cast<long>(std::ceil(duration / wanted - 1e-9)));
    const double h = duration / static_cast<double>(steps);
    MotionRecorder recorder(mechanism, prepared.ideal(), options, static_cast<double>(steps));
    VecX y = VecX::Zero(2 * n);
    ExplicitRungeKutta method(classical_rk4(), 2 * n);
    const double limit = classical_rk4().real_limit;
    bool interrupted = false;
    MatX compliance;
    Nonlinearity nonlinearity;
    double fastest = 0.0;  // squared, a bound
    std::array<ContactState<double>, kContactPlaces> contact;
    for (long i = 0;; ++i) {
      const double t = static_cast<double>(i) * h;
      if (!y.allFinite())
        throw ComputationError("the deviation grew without bound before t = " + std::to_string(t) + " s; take a smaller step");
      scene_at(t);
      for (std::size_t c = 0; c < joints.size(); ++c) {
        motion[c] = journal_motion(at, at.joints[c], row.data(), y.data(), y.data() + n);
        joints[c].gaps(motion[c], contact);
        trackers[c].accept(t, contact);
        memory[c] = trackers[c].memory();
      }
      derivative(t, y, method.first_slope());
      for (std::size_t c = 0; c < joints.size(); ++c) trackers[c].observe_forces(wrench[c].contact);
      if (std::any_of(trackers.begin(), trackers.end(), [](const ContactTracker& c) { return c.touching(); })) {
        offset_compliance(at, offsets, row.data(), compliance);
        const double bound = stiffest_contact_bound(offsets, joints, motion, compliance);
        fastest = std::max(fastest, bound);
        if (h * h * bound > limit * limit) {
          const StiffestContact stiffest = stiffest_contact(offsets, joints, motion, compliance);
          if (h * stiffest.angular_frequency > limit) throw UnstableStep(mechanism, stiffest, t, h);
        }
      }
      record(prepared, options, t, y, method.first_slope(), motion, wrench, recorder, nonlinearity);
      if (i == steps) break;
      if (options.progress && i % 4096 == 0 && !options.progress({t, duration, recorder.position_error_max()})) {
        interrupted = true;
        break;
      }
      method.step(t, h, y, derivative);
    }

    RunResult result = recorder.finish();
    char text[60];
    std::snprintf(text, sizeof text, "RK4, h = %.6g s", h);
    result.integrator = text;
    for (ContactTracker& tracker : trackers) result.contact.push_back(tracker.finish(result.end_time, result.events));
    std::stable_sort(result.events.begin(), result.events.end(),
                     [](const ContactEvent& a, const ContactEvent& b) { return a.start < b.start; });
    result.interrupted = interrupted;
    result.error = {nonlinearity.share(mechanism.characteristic_length()), step_error(std::sqrt(fastest), h),
                    "size of the deviation against the mechanism, times how much the mechanism magnifies offsets; the step "
                    "against the stiffest contact met"};
    result.cost.steps = steps;
    result.cost.evaluations = 4 * steps + 1;
    return result;
  }

  // How forces on the offsets accelerate the offsets: B A B^T, with B picking coordinates where offsets are such.
  static void offset_compliance(const SceneLayout& at, const OffsetLayout& offsets, const double* row, MatX& compliance) {
    const Eigen::Map<const MatX> A(row + at.A, at.n, at.n);  // symmetric: rows and columns read the same
    compliance.setZero(offsets.size(), offsets.size());
    bool dependent = false;
    for (int c = 0; c < offsets.clearances(); ++c) dependent = dependent || at.joints[c].has_dependent;
    if (!dependent) {
      for (int c = 0; c < offsets.clearances(); ++c)
        for (int i = 0; i < at.joints[c].offsets; ++i)
          for (int d = 0; d < offsets.clearances(); ++d)
            for (int j = 0; j < at.joints[d].offsets; ++j)
              if (at.joints[c].source[i] >= 0 && at.joints[d].source[j] >= 0)
                compliance(offsets.joint(c).first + i, offsets.joint(d).first + j) =
                    A(at.joints[c].source[i], at.joints[d].source[j]);
      return;
    }
    MatX B = MatX::Zero(offsets.size(), at.n);
    for (int c = 0; c < offsets.clearances(); ++c)
      for (int i = 0; i < at.joints[c].offsets; ++i) {
        const int source = at.joints[c].source[i], to = offsets.joint(c).first + i;
        if (source >= 0) B(to, source) = 1.0;
        if (source == DeviationCoordinates::kDependent)
          B.row(to) = Eigen::Map<const Eigen::RowVectorXd>(row + at.joints[c].dependent + i * at.n, at.n);
      }
    compliance = B * A * B.transpose();
  }

  void record(const PreparedScene& prepared, const RunOptions& options, double t, const VecX& y, const VecX& slope,
              const std::vector<JournalMotion<double>>& motion, const std::vector<JournalWrench<double>>& wrench,
              MotionRecorder& recorder, Nonlinearity& nonlinearity) const {
    const Eigen::Index n = y.size() / 2;
    const DisplacedBodies displaced(prepared, t, y.head(n));
    BodyAcceleration a;
    BodyMotion body = displaced.moving(mechanism().boresight_body(), y.tail(n), slope.tail(n), a);
    nonlinearity.add(recorder.accept(t, body, a), y.head(n), mechanism().characteristic_length());
    if (!recorder.sampling()) return;
    for (std::size_t k = 0; k < options.pose_bodies.size(); ++k) {
      body = displaced.moving(options.pose_bodies[k], y.tail(n), slope.tail(n), a);
      recorder.sample_body(static_cast<int>(k), body, a);
    }
    for (std::size_t c = 0; c < motion.size(); ++c)
      recorder.sample_clearance(static_cast<int>(c), motion[c], wrench[c].contact);
  }
};

}  // namespace

std::unique_ptr<Rung> make_perturbation(std::shared_ptr<const Mechanism> mechanism) {
  return std::make_unique<Perturbation>(std::move(mechanism));
}

}  // namespace boresight
