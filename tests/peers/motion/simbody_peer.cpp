// The scene in Simbody (Sherman, Seth, Delp 2011, Procedia IUTAM 2, 241-261), as its own users write one: a
// tree of mobilizers, the drives as position-level motions, loops closed by constraints, the contact as a
// custom force.
//
// Default scene: 16 mobilities, 6 of them driven, 7 rows. A revolute loop joint is a Ball and two
// ConstantAngle; the clearance joint keeps the two angles and loses the Ball.
#include <Simbody.h>

#include "boresight/rungs/cpu_clock.hpp"
#include "peer.hpp"

namespace boresight::peers {
namespace {

namespace st = SimTK;

st::Vec3 vec(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 eigen(const st::Vec3& v) { return {v[0], v[1], v[2]}; }
Mat3 eigen(const st::Rotation& R) {
  Mat3 m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m(i, j) = R.asMat33()(i, j);
  return m;
}

// A joint's frame with its axis, our y, turned to Simbody's letter: z of a Pin or Cylinder, x of a Slider.
st::Transform frame(const JointFrame& f, bool slider) {
  Mat3 R;
  if (slider)
    R << f.R.col(1), f.R.col(2), f.R.col(0);
  else
    R << f.R.col(2), f.R.col(0), f.R.col(1);
  st::Mat33 m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m(i, j) = R(i, j);
  return {st::Rotation(m), vec(f.p)};
}

class DriveMotion : public st::Motion::Custom::Implementation {
 public:
  DriveMotion(Drives& drives, int joint) : drives_(drives), joint_(joint) {}
  st::Motion::Level getLevel(const st::State&) const override { return st::Motion::Position; }
  void calcPrescribedPosition(const st::State& s, int, st::Real* q) const override {
    *q = drives_.at(s.getTime(), joint_).value;
  }
  void calcPrescribedPositionDot(const st::State& s, int, st::Real* qdot) const override {
    *qdot = drives_.at(s.getTime(), joint_).rate;
  }
  void calcPrescribedPositionDotDot(const st::State& s, int, st::Real* qdotdot) const override {
    *qdotdot = drives_.at(s.getTime(), joint_).acceleration;
  }

 private:
  Drives& drives_;
  int joint_;
};

void read(const st::MobilizedBody& body, const st::State& s, BodyMotion& out) {
  const st::Transform& X = body.getBodyTransform(s);
  const st::SpatialVec& V = body.getBodyVelocity(s);
  out = {eigen(X.p()), eigen(X.R()), eigen(V[1]), eigen(V[0])};
}

class ContactForce : public st::Force::Custom::Implementation {
 public:
  ContactForce(PeerContact& contact, const st::MobilizedBody& journal, const st::MobilizedBody& sleeve)
      : contact_(contact), journal_(journal), sleeve_(sleeve) {}
  void calcForce(const st::State& s, st::Vector_<st::SpatialVec>& on_bodies, st::Vector_<st::Vec3>&,
                 st::Vector&) const override {
    Vec6 on_journal, on_sleeve;
    read(journal_, s, contact_.journal());
    read(sleeve_, s, contact_.sleeve());
    contact_.forces(s.getTime(), on_journal, on_sleeve);
    add(on_journal, on_bodies[journal_.getMobilizedBodyIndex()]);
    add(on_sleeve, on_bodies[sleeve_.getMobilizedBodyIndex()]);
  }
  st::Real calcPotentialEnergy(const st::State&) const override { return 0.0; }

 private:
  static void add(const Vec6& wrench, st::SpatialVec& to) {
    to[0] += vec(wrench.tail<3>());
    to[1] += vec(wrench.head<3>());
  }
  PeerContact& contact_;
  const st::MobilizedBody &journal_, &sleeve_;
};

class Model {
 public:
  Model(const PeerScene& scene, bool with_clearance)
      : scene_(scene), matter_(system_), forces_(system_), drives_(scene), contact_(scene) {
    const MechanismDescription& m = scene.description();
    st::Force::Gravity(forces_, matter_, vec(scene.parameters().gravity));
    bodies_.resize(m.bodies.size());
    for (const PeerScene::TreeJoint& t : scene.tree()) hang(t);
    for (int loop : scene.loops()) close(loop, true);
    close(scene.clearance_joint(), !with_clearance);
    if (with_clearance)
      st::Force::Custom(forces_, new ContactForce(contact_, bodies_[scene.journal()], bodies_[scene.sleeve()]));
    system_.realizeTopology();
  }

  st::State start() const {
    st::State s = system_.getDefaultState();
    for (const PeerScene::TreeJoint& t : scene_.tree()) {
      const JointType type = scene_.description().joints[t.joint].type;
      if (type == JointType::prismatic)
        bodies_[t.child].setOneU(s, 0, scene_.sliding_rate(t.joint));
      else
        bodies_[t.child].setOneU(s, 0, scene_.turning_rate(t.joint));
      if (type == JointType::cylindrical) bodies_[t.child].setOneU(s, 1, scene_.sliding_rate(t.joint));
    }
    return s;
  }

  st::MultibodySystem& system() { return system_; }
  const st::MobilizedBody& body(int b) const { return bodies_[b]; }
  PeerContact& contact() { return contact_; }

 private:
  st::MobilizedBody& mobilized(int body) { return body == kGround ? matter_.updGround() : bodies_[body]; }

  void hang(const PeerScene::TreeJoint& t) {
    const JointDescription& d = scene_.description().joints[t.joint];
    const JointGeometry& g = scene_.mechanism().geometry(t.joint);
    const MassProperties& mass = scene_.mass()[t.child];
    // Simbody's inertia is about the body's origin, which is the body's own centre of mass.
    const Mat3 I = mass.inertia + mass.mass * (mass.c.squaredNorm() * Mat3::Identity() - mass.c * mass.c.transpose());
    const st::Body::Rigid rigid(
        st::MassProperties(mass.mass, vec(mass.c), st::Inertia(I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2))));
    const bool slider = d.type == JointType::prismatic;
    const st::Transform in_parent = frame(g.first, slider), in_child = frame(g.second, slider);
    st::MobilizedBody& parent = mobilized(t.parent);
    st::MobilizedBody& child = bodies_[t.child];
    if (slider)
      child = st::MobilizedBody::Slider(parent, in_parent, rigid, in_child);
    else if (d.type == JointType::revolute)
      child = st::MobilizedBody::Pin(parent, in_parent, rigid, in_child);
    else if (d.type == JointType::cylindrical)
      child = st::MobilizedBody::Cylinder(parent, in_parent, rigid, in_child);
    else
      throw std::invalid_argument(std::string("the Simbody peer has no ") + to_string(d.type) + " joint");
    if (d.driven) st::Motion::Custom(child, new DriveMotion(drives_, t.joint));
  }

  // A revolute joint: its point, if held, and the direction of its axis.
  void close(int joint, bool point) {
    const JointDescription& d = scene_.description().joints[joint];
    const JointGeometry& g = scene_.mechanism().geometry(joint);
    if (d.type != JointType::revolute) throw std::invalid_argument("the Simbody peer closes loops by revolute joints");
    st::MobilizedBody &first = mobilized(d.first), &second = mobilized(d.second);
    if (point) st::Constraint::Ball(first, vec(g.first.p), second, vec(g.second.p));
    const st::UnitVec3 axis(vec(g.first.R.col(1)));
    for (int k : {0, 2})
      st::Constraint::ConstantAngle(first, axis, second, st::UnitVec3(vec(g.second.R.col(k))), 0.5 * st::Pi);
  }

  const PeerScene& scene_;
  st::MultibodySystem system_;
  st::SimbodyMatterSubsystem matter_;
  st::GeneralForceSubsystem forces_;
  Drives drives_;
  PeerContact contact_;
  std::vector<st::MobilizedBody> bodies_;
};

std::unique_ptr<st::Integrator> integrator(const st::System& system, const PeerSetting& setting) {
  std::unique_ptr<st::Integrator> out;
  if (setting.method == "Runge-Kutta-Merson")
    out = std::make_unique<st::RungeKuttaMersonIntegrator>(system);
  else if (setting.method == "Runge-Kutta 3")
    out = std::make_unique<st::RungeKutta3Integrator>(system);
  else
    throw std::invalid_argument("the Simbody peer has no integrator " + setting.method);
  out->setAccuracy(setting.accuracy);
  out->setConstraintTolerance(std::min(1e-7, 1e-3 * setting.accuracy));
  out->setReturnEveryInternalStep(true);
  return out;
}

class SimbodyPeer final : public Peer {
 public:
  std::string name() const override {
    int major, minor, build;
    SimTK_version_simbody(&major, &minor, &build);
    return "Simbody " + std::to_string(major) + "." + std::to_string(minor);
  }
  std::string models() const override {
    return "Mobilizer tree with driven mobilities, loops closed by Ball and ConstantAngle, the contact as a "
           "custom force; "
           "the package as the distribution built it.";
  }
  bool stands_alone() const override { return true; }
  std::vector<PeerSetting> settings() const override {
    std::vector<PeerSetting> all;
    for (const char* method : {"Runge-Kutta-Merson", "Runge-Kutta 3"})
      for (double accuracy : {1e-2, 1e-3, 1e-4, 1e-5}) all.push_back({method, 0.0, accuracy});
    return all;
  }
  PeerSetting proving_setting() const override { return {"Runge-Kutta-Merson", 0.0, 1e-7}; }

  PeerMotion follow(const PeerScene& scene, const PeerRequest& request) const override {
    Model model(scene, request.with_clearance);
    const double duration = request.duration > 0.0 ? request.duration : scene.duration();
    const auto integ = integrator(model.system(), request.setting);
    const int body = scene.mechanism().boresight_body();
    PeerContact& contact = model.contact();
    PeerMotion out;
    IndexWatch index(scene);
    const double start = thread_cpu_seconds();
    try {
      integ->setFinalTime(duration);
      integ->initialize(model.start());
      for (;;) {
        const st::State& s = integ->getState();
        model.system().realize(s, st::Stage::Velocity);
        const double t = s.getTime();
        read(model.body(scene.journal()), s, contact.journal());
        read(model.body(scene.sleeve()), s, contact.sleeve());
        contact.accept(t);
        const st::Transform& X = model.body(body).getBodyTransform(s);
        index.accept(t, eigen(X.p()));
        if (request.keep_path) out.path.push_back({t, eigen(X.p()), eigen(X.R())});
        ++out.steps;
        if (t >= duration || integ->isSimulationOver()) break;
        if (thread_cpu_seconds() - start > request.most_seconds)
          throw PeerFailure("given up at t = " + std::to_string(t) + " s of the motion");
        integ->stepTo(duration);
      }
    } catch (const st::Exception::Base& failure) {
      throw PeerFailure(failure.what());
    }
    out.cpu_seconds = thread_cpu_seconds() - start;
    const IndexWatch::Result error = index.result();
    out.largest = error.max;
    out.rms = error.rms;
    out.evaluations = contact.evaluations();
    out.first_contact = contact.first_contact();
    return out;
  }
};

}  // namespace

std::unique_ptr<Peer> make_simbody_peer() { return std::make_unique<SimbodyPeer>(); }

}  // namespace boresight::peers
