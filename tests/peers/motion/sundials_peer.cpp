// SUNDIALS brings integrators and no mechanisms: it gets our right-hand sides, that of multibody in joint
// coordinates (with Baumgarte's stabilisation, since its multistep methods take no projection) and that of
// the perturbation rung.
#include <functional>
#include <optional>

#include "boresight/contact_events/contact_tracker.hpp"
#include "boresight/formulations/formulation.hpp"
#include "boresight/multibody/multibody_system.hpp"
#include "boresight/perturbation/perturbation_system.hpp"
#include "boresight/rungs/cpu_clock.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight/scene/scene_rung.hpp"
#include "boresight/stepping/unstable_step.hpp"
#include "peer.hpp"
#include "sundials_drive.hpp"

namespace boresight::peers {
namespace {

constexpr struct {
  const char* name;
  SundialsMethod method;
} kMethods[] = {{"CVODE BDF", SundialsMethod::cvode_bdf},
                {"CVODE Adams", SundialsMethod::cvode_adams},
                {"ARKODE explicit", SundialsMethod::arkode_erk},
                {"ARKODE implicit", SundialsMethod::arkode_dirk}};

SundialsMethod method_named(const std::string& name) {
  for (const auto& m : kMethods)
    if (name == m.name) return m.method;
  throw std::invalid_argument("SUNDIALS has no " + name);
}

// Accuracy: error of one step over the clearance, as our rungs' tolerance.
VecX tolerances(const PeerScene& scene, const PeerRequest& request, Eigen::Index size,
                const std::function<bool(int)>& is_speed, double length) {
  VecX all = VecX::Constant(size, request.setting.accuracy * smallest_clearance(scene.parameters()) / length);
  for (int k = 0; k < size; ++k)
    if (is_speed(k)) all[k] /= kFlightTime;
  return all;
}

// pose(t, y): of the boresight body.
template <typename System>
PeerMotion drive(System& system, const VecX& start, const VecX& tolerance, const PeerScene& scene,
                 const PeerRequest& request, const std::function<PeerPose(double, const double*)>& pose) {
  const double duration = request.duration > 0.0 ? request.duration : scene.duration();
  PeerMotion out;
  IndexWatch index(scene);
  const double began = thread_cpu_seconds();
  const auto observe = [&](double t, const double* y) {
    const PeerPose now = pose(t, y);
    index.accept(t, now.p);
    if (request.keep_path) out.path.push_back(now);
    if (thread_cpu_seconds() - began > request.most_seconds)
      throw PeerFailure("given up at t = " + std::to_string(t) + " s of the motion");
    return true;
  };
  try {
    SundialsRun<System> run(system, start, tolerance);
    observe(0.0, start.data());
    run.follow(method_named(request.setting.method), duration, kPaperStep, observe);
    out.cpu_seconds = thread_cpu_seconds() - began;
    out.evaluations = run.evaluations();
    out.steps = run.steps();
  } catch (const PeerFailure&) {
    throw;
  } catch (const std::runtime_error& failure) {
    throw PeerFailure(failure.what());
  }
  const IndexWatch::Result error = index.result();
  out.largest = error.max;
  out.rms = error.rms;
  return out;
}

double first_contact(std::vector<ContactTracker>& trackers, double end) {
  std::vector<ContactEvent> events;
  for (ContactTracker& tracker : trackers) tracker.finish(end, events);
  double first = -1.0;
  for (const ContactEvent& e : events) first = first < 0.0 ? e.start : std::min(first, e.start);
  return first;
}

class SundialsPeer : public Peer {
 public:
  std::string name() const override { return std::string("SUNDIALS ") + SUNDIALS_VERSION + " on " + rung_; }
  std::string models() const override { return "Integrators only, on our right-hand side of the " + rung_ + " rung."; }
  bool stands_alone() const override { return false; }
  std::vector<PeerSetting> settings() const override {
    std::vector<PeerSetting> all;
    for (const auto& m : kMethods)
      for (double accuracy : {1e-1, 1e-2, 1e-3, 1e-4}) all.push_back({m.name, 0.0, accuracy});
    return all;
  }
  PeerSetting proving_setting() const override { return {"ARKODE explicit", 0.0, 1e-5}; }

 protected:
  explicit SundialsPeer(std::string rung) : rung_(std::move(rung)) {}
  std::string rung_;
};

class OnMultibody final : public SundialsPeer {
 public:
  OnMultibody() : SundialsPeer("multibody") {}
  PeerMotion follow(const PeerScene& scene, const PeerRequest& request) const override {
    const auto formulation =
        make_tree_formulation(scene.mechanism(), scene.parameters(), &scene.ideal(),
                              {.with_clearance = request.with_clearance, .stabilisation = Stabilisation::baumgarte});
    std::vector<ContactTracker> trackers;
    if (request.with_clearance) trackers.emplace_back(0, "", formulation->forces().joint(0), true);
    VecX y;
    formulation->start(scene.start(), y);
    MultibodySystem system(*formulation, trackers, scene.mechanism().characteristic_length());
    system.start(0.0, y);
    const int body = scene.mechanism().boresight_body();
    VecX state(y.size());
    PeerMotion out = drive(system, y,
                           tolerances(
                               scene, request, y.size(), [&](int k) { return formulation->is_speed(k); },
                               std::max(1.0, scene.mechanism().characteristic_length())),
                           scene, request, [&](double t, const double* numbers) -> PeerPose {
                             state = Eigen::Map<const VecX>(numbers, state.size());
                             const BodyMotion& b = formulation->bodies(t, state)[body];
                             return {t, b.p, b.R};
                           });
    out.evaluations += system.evaluations();  // of its Jacobians
    out.first_contact = first_contact(trackers, scene.duration());
    return out;
  }
};

class OnPerturbation final : public SundialsPeer {
 public:
  OnPerturbation() : SundialsPeer("perturbation") {}
  PeerMotion follow(const PeerScene& scene, const PeerRequest& request) const override {
    if (!request.with_clearance) throw NoIdealMotion("without clearance there is no deviation to follow");
    const PreparedScene& prepared = prepared_for(scene);
    const auto tables = prepared.tables(scene.parameters());
    const int n = tables->layout.n, body = scene.mechanism().boresight_body();
    const TimeTable& gain = prepared.pose_gain(body);
    std::vector<double> row(gain.width());
    PerturbationSystem system(scene.mechanism(), scene.parameters(), tables, true);
    const VecX y = VecX::Zero(system.size());
    system.start_located(0.0, y);
    PeerMotion out =
        drive(system, y,
              tolerances(
                  scene, request, y.size(), [n](int k) { return k >= n; }, 1.0),
              scene, request, [&](double t, const double* z) -> PeerPose {
                gain.at(t, row.data());
                const Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>> E(row.data(), 6, n);
                BodyMotion b = scene.ideal().body(t, body);
                displace(b, E * Eigen::Map<const VecX>(z, n));
                return {t, b.p, b.R};
              });
    out.first_contact = first_contact(system.trackers(), scene.duration());
    return out;
  }

 private:
  // Once for a scene, as the rung does.
  const PreparedScene& prepared_for(const PeerScene& scene) const {
    if (prepared_of_ != &scene) {
      prepared_.emplace(scene.mechanism(), scene.ideal(), scene.parameters());
      prepared_of_ = &scene;
    }
    return *prepared_;
  }
  mutable std::optional<PreparedScene> prepared_;
  mutable const PeerScene* prepared_of_ = nullptr;
};

}  // namespace

std::unique_ptr<Peer> make_sundials_multibody_peer() { return std::make_unique<OnMultibody>(); }
std::unique_ptr<Peer> make_sundials_perturbation_peer() { return std::make_unique<OnPerturbation>(); }

}  // namespace boresight::peers
