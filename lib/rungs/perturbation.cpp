#include "boresight/rungs/perturbation.hpp"

#include <algorithm>
#include <Eigen/LU>
#include <cmath>
#include <cstdio>

#include "boresight/integrate/explicit_runge_kutta.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/contact_tracker.hpp"
#include "boresight/rungs/motion_recorder.hpp"
#include "boresight/rungs/offset_dynamics.hpp"
#include "boresight/rungs/reaction_table.hpp"
#include "boresight/rungs/scene_rung.hpp"
#include "boresight/rungs/unstable_step.hpp"

namespace boresight {
namespace {


class Perturbation final : public SceneRung {
 public:
  explicit Perturbation(std::shared_ptr<const Mechanism> mechanism) : SceneRung(std::move(mechanism)) {}

  std::string name() const override { return "perturbation"; }
  std::string leaves_out() const override {
    return "The deviation from the ideal motion is linear in the joint offsets: how the pose, the masses and the reactions "
           "change with the offset itself is left out, which grows with clearance over link length and near singular poses.";
  }

 private:
  RunResult follow(const Parameters& parameters, const RunOptions& options) const override {
    const double own = options.step > 0.0 ? options.step : own_step(parameters);
    return with_stable_step(options.step, own, options.sample_spacing,
                            [&](double step) { return integrate(parameters, options, step); });
  }

  // Share of the stable step of the joints' contacts taken together, at twice the largest ideal reaction: what a load
  // suddenly applied to an elastic contact reaches.
  double own_step(const Parameters& parameters) const {
    const ReactionTable reactions(mechanism(), scene(), parameters);
    std::vector<JournalMotion<double>> deepest(reactions.joints().size());
    for (int i = 0; i < reactions.instants(); ++i) {
      const VecX r = reactions.at(i).reaction;
      for (std::size_t c = 0; c < deepest.size(); ++c) {
        const JournalInSleeve& joint = reactions.joints()[c];
        const double force = 2.0 * r.segment<3>(3 * static_cast<int>(c)).norm();
        const double reach = joint.radial_clearance + std::pow(force / joint.radial_law.stiffness, 2.0 / 3.0);
        if (reach > deepest[c].e.x()) deepest[c].e = Vec3(reach, 2.0 * joint.axial_clearance + 1e-9, 0.0);
      }
    }
    double fastest = 0.0;
    MatX M, C;
    VecX r;
    for (int k = 0; k < scene().knots(); k += 8) {
      scene().assemble(parameters, k, M, C, r);
      fastest = std::max(fastest, stiffest_contact_bound(reactions.joints(), deepest, MatX(M.inverse())));
    }
    const double step = std::min(kPaperStep, mechanism().duration() / 100.0);
    return fastest > 0.0 ? std::min(step, kShareOfStableStep * classical_rk4().real_limit / std::sqrt(fastest)) : step;
  }

  RunResult integrate(const Parameters& parameters, const RunOptions& options, double wanted) const {
    const Mechanism& mechanism = this->mechanism();
    const MechanismDescription& m = mechanism.description();
    const SceneTables tables = this->scene().tables(parameters);
    const SceneRow at(tables.clearances);
    const int n = at.n;
    const double duration = mechanism.duration();

    std::vector<JournalInSleeve> joints;
    std::vector<bool> slides;
    std::vector<ContactTracker> trackers;
    for (int c = 0; c < mechanism.clearances(); ++c) {
      const JointDescription& joint = m.joints[m.clearances[c].joint];
      joints.emplace_back(m.clearances[c], joint.type, parameters.clearance[c]);
      slides.push_back(joint.type == JointType::cylindrical);
      trackers.emplace_back(c, joint.name, joints.back(), options.events);
    }
    std::vector<ContactMemory> memory(joints.size());
    std::vector<JournalMotion<double>> motion(joints.size());
    std::vector<JournalWrench<double>> wrench(joints.size());
    std::vector<double> row(tables.dynamics.width()), gain(tables.pose.width()), force(n);
    double scene_time = -1.0;
    const auto scene_at = [&](double t) {
      if (t == scene_time) return;  // two stages of a step share their time, and so do a step's end and the next one's start
      tables.dynamics.at(t, row.data());
      scene_time = t;
    };
    const auto derivative = [&](double t, const VecX& y, VecX& dy) {
      scene_at(t);
      const double *xi = y.data(), *rate = xi + n;
      std::fill(force.begin(), force.end(), 0.0);
      for (std::size_t c = 0; c < joints.size(); ++c) {
        const int k = static_cast<int>(c);
        motion[c] = journal_motion(at, row.data(), slides[c], k, xi, rate);
        joints[c].wrench(motion[c], memory[c].impact_speed, wrench[c]);
        add_generalised_force(at, row.data(), slides[c], k, wrench[c], force.data());
      }
      std::copy(rate, rate + n, dy.data());
      offset_acceleration(at, row.data(), rate, force.data(), dy.data() + n);
    };

    const long steps = std::max(1L, static_cast<long>(std::ceil(duration / wanted - 1e-9)));
    const double h = duration / static_cast<double>(steps);
    MotionRecorder recorder(mechanism, ideal(), options, static_cast<double>(steps));
    VecX y = VecX::Zero(2 * n);
    ExplicitRungeKutta method(classical_rk4(), 2 * n);
    const double limit = classical_rk4().real_limit;
    bool interrupted = false;
    std::array<ContactState<double>, kContactPlaces> contact;
    for (long i = 0;; ++i) {
      const double t = static_cast<double>(i) * h;
      if (!y.allFinite())
        throw ComputationError("the deviation grew without bound before t = " + std::to_string(t) + " s; take a smaller step");
      scene_at(t);
      for (std::size_t c = 0; c < joints.size(); ++c) {
        motion[c] = journal_motion(at, row.data(), slides[c], static_cast<int>(c), y.data(), y.data() + n);
        joints[c].gaps(motion[c], contact);
        trackers[c].accept(t, contact);
        memory[c] = trackers[c].memory();
      }
      derivative(t, y, method.first_slope());
      for (std::size_t c = 0; c < joints.size(); ++c) trackers[c].observe_forces(wrench[c].contact);
      const Eigen::Map<const MatX> A(row.data() + at.A, n, n);  // symmetric: rows and columns read the same
      if (h * h * stiffest_contact_bound(joints, motion, A) > limit * limit) {
        const StiffestContact stiffest = stiffest_contact(joints, motion, A);
        if (h * stiffest.angular_frequency > limit) throw UnstableStep(mechanism, stiffest, t, h);
      }
      record(t, y, method.first_slope(), tables, gain, motion, wrench, recorder);
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
    result.cost.steps = steps;
    result.cost.evaluations = 4 * steps + 1;
    return result;
  }

  // The boresight body at an accepted state: the ideal motion displaced by E xi.
  void record(double t, const VecX& y, const VecX& slope, const SceneTables& tables, std::vector<double>& gain,
              const std::vector<JournalMotion<double>>& motion, const std::vector<JournalWrench<double>>& wrench,
              MotionRecorder& recorder) const {
    const int n = static_cast<int>(y.size()) / 2;
    tables.pose.at(t, gain.data());
    const Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>> E(gain.data(), 6, n);
    const Vec6 error = E * y.head(n), rate = E * y.tail(n), acceleration = E * slope.tail(n);
    BodyAcceleration a;
    BodyMotion body = ideal().body(t, mechanism().boresight_body(), &a);
    displace(body, error);
    body.v += rate.head<3>();
    body.w += rate.tail<3>();
    a += acceleration;
    recorder.accept(t, body, a);
    if (!recorder.sampling()) return;
    for (std::size_t c = 0; c < motion.size(); ++c)
      recorder.sample_clearance(static_cast<int>(c), motion[c], wrench[c].contact);
  }
};

}  // namespace

std::unique_ptr<Rung> make_perturbation(std::shared_ptr<const Mechanism> mechanism) {
  return std::make_unique<Perturbation>(std::move(mechanism));
}

}  // namespace boresight
