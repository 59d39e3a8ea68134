// The scene in MuJoCo (Todorov, Erez, Tassa 2012, IROS, 5026-5033). Its joints have no play and its
// constraints are soft, so: a grain of 1 g on three slides in the sleeve carries the clearance, and is held
// to the journal by two `connect`s on the axis; loops are closed by two such `connect`s; drives have a large
// armature, are fed its torque and set to their law after every step; the contact is a passive force.
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <cstring>

#include "boresight/rungs/cpu_clock.hpp"
#include "peer.hpp"

namespace boresight::peers {
namespace {

// Of a drive: what the mechanism does to it within a step is lost against this [kg m^2, kg].
constexpr double kArmature = 1e6;
// Between the two connects that hold an axis, and its middle [m].
constexpr double kHalfAxis = 0.1;
// MuJoCo gives its constraints the softness of the bodies' own inertia; as that comes, loops give way by 0.17
// mrad under the load of this scene. A hundredth of a percent of it is left.
constexpr double kSoftness = 1e-4;

std::string numbers(const Vec3& v) { return fmt::format("{:.17g} {:.17g} {:.17g}", v.x(), v.y(), v.z()); }
std::string turn(const Mat3& R) {
  const Quat q(R);
  return fmt::format("{:.17g} {:.17g} {:.17g} {:.17g}", q.w(), q.x(), q.y(), q.z());
}

class ModelText {
 public:
  ModelText(const PeerScene& scene, const PeerRequest& request) : scene_(scene), m_(scene.description()) {
    const bool runge_kutta = request.setting.method == "RK4";
    text_ = fmt::format(
        "<mujoco><compiler angle=\"radian\" inertiafromgeom=\"false\" boundmass=\"0\" boundinertia=\"0\"/>"
        "<size nconmax=\"1\" njmax=\"50\"/>"
        "<option timestep=\"{:.17g}\" integrator=\"{}\" gravity=\"{}\" solver=\"Newton\" tolerance=\"1e-12\">"
        "<flag contact=\"disable\" frictionloss=\"disable\" limit=\"disable\" actuation=\"disable\" "
        "sensornoise=\"disable\"/>"
        "</option><worldbody>",
        request.setting.step, runge_kutta ? "RK4" : request.setting.method, numbers(scene.parameters().gravity));
    for (const PeerScene::TreeJoint& t : scene.tree())
      if (t.parent == kGround) body(t, request.with_clearance);
    text_ += "</worldbody><equality>";
    for (int loop : scene.loops()) {
      const JointDescription& d = m_.joints[loop];
      hold(m_.bodies[d.first].name, m_.bodies[d.second].name, scene.mechanism().geometry(loop).first, request);
    }
    const std::string& journal = m_.bodies[scene.journal()].name;
    if (request.with_clearance)
      hold("grain", journal, JointFrame{}, request);
    else
      hold(m_.bodies[scene.sleeve()].name, journal, sleeve_frame(), request);
    text_ += "</equality></mujoco>";
  }
  const std::string& text() const { return text_; }

 private:
  JointFrame sleeve_frame() const {
    const JointGeometry& g = scene_.mechanism().geometry(scene_.clearance_joint());
    return g.first.body == scene_.sleeve() ? g.first : g.second;
  }

  void body(const PeerScene::TreeJoint& t, bool with_clearance) {
    const BodyDescription& child = m_.bodies[t.child];
    Vec3 p = child.center_of_mass;
    Mat3 R = child.axes;
    if (t.parent != kGround) {
      const BodyDescription& parent = m_.bodies[t.parent];
      p = parent.axes.transpose() * (p - parent.center_of_mass);
      R = parent.axes.transpose() * R;
    }
    const MassProperties& mass = scene_.mass()[t.child];
    const Mat3& I = mass.inertia;
    text_ += fmt::format(
        "<body name=\"{}\" pos=\"{}\" quat=\"{}\"><inertial mass=\"{:.17g}\" pos=\"{}\" "
        "fullinertia=\"{:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\"/>",
        child.name, numbers(p), turn(R), mass.mass, numbers(mass.c), I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2),
        I(1, 2));
    const JointDescription& d = m_.joints[t.joint];
    const JointFrame& f = scene_.mechanism().geometry(t.joint).second;
    if (d.type != JointType::prismatic) joint(d.name, "hinge", f.p, f.R.col(1), d.driven);
    if (d.type == JointType::prismatic) joint(d.name, "slide", f.p, f.R.col(1), d.driven);
    if (d.type == JointType::cylindrical) joint(d.name + "-slide", "slide", f.p, f.R.col(1), false);
    if (with_clearance && t.child == scene_.sleeve()) {
      const JointFrame sleeve = sleeve_frame();
      text_ += fmt::format(
          "<body name=\"grain\" pos=\"{}\" quat=\"{}\"><inertial mass=\"1e-3\" pos=\"0 0 0\" "
          "diaginertia=\"1e-8 1e-8 1e-8\"/>",
          numbers(sleeve.p), turn(sleeve.R));
      for (int k = 0; k < 3; ++k) joint("play" + std::to_string(k), "slide", Vec3::Zero(), Vec3::Unit(k), false);
      text_ += "</body>";
    }
    for (const PeerScene::TreeJoint& next : scene_.tree())
      if (next.parent == t.child) body(next, with_clearance);
    text_ += "</body>";
  }

  void joint(const std::string& name, const char* type, const Vec3& p, const Vec3& axis, bool driven) {
    text_ += fmt::format("<joint name=\"{}\" type=\"{}\" pos=\"{}\" axis=\"{}\" armature=\"{:g}\"/>", name, type,
                         numbers(p), numbers(axis), driven ? kArmature : 0.0);
  }

  // The axis of a joint's frame, at two points.
  void hold(const std::string& first, const std::string& second, const JointFrame& f, const PeerRequest& request) {
    for (double side : {-kHalfAxis, kHalfAxis})
      text_ += fmt::format(
          "<connect body1=\"{}\" body2=\"{}\" anchor=\"{}\" solref=\"{:.17g} 1\" solimp=\"0.9999 0.9999 "
          "0.001 0.5 2\"/>",
          first, second, numbers(f.p + side * f.R.col(1)), 2.0 * request.setting.step);
  }

  const PeerScene& scene_;
  const MechanismDescription& m_;
  std::string text_;
};

class Run {
 public:
  Run(const PeerScene& scene, const PeerRequest& request)
      : scene_(scene), request_(request), drives_(scene), contact_(scene), index_(scene) {
    const std::string text = ModelText(scene, request).text();
    auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "scene.xml", static_cast<int>(text.size()));
    std::memcpy(files->filedata[mj_findFileVFS(files.get(), "scene.xml")], text.data(), text.size());
    char error[1000] = "";
    model_.reset(mj_loadXML("scene.xml", files.get(), error, sizeof error));
    mj_deleteVFS(files.get());
    if (!model_) throw PeerFailure(std::string("MuJoCo refuses the model: ") + error);
    for (int k = 0; k < 2 * model_->nbody; ++k) model_->body_invweight0[k] *= kSoftness;
    data_.reset(mj_makeData(model_.get()));
    const MechanismDescription& m = scene.description();
    for (const PeerScene::TreeJoint& t : scene.tree()) {
      const JointDescription& d = m.joints[t.joint];
      const int joint = mj_name2id(model_.get(), mjOBJ_JOINT, d.name.c_str());
      const int q = model_->jnt_qposadr[joint], v = model_->jnt_dofadr[joint];
      const bool slides = d.type == JointType::prismatic;
      data_->qvel[v] = slides ? scene.sliding_rate(t.joint) : scene.turning_rate(t.joint);
      if (d.type == JointType::cylindrical) data_->qvel[v + 1] = scene.sliding_rate(t.joint);
      if (d.driven) driven_.push_back({t.joint, q, v});
    }
    journal_ = mj_name2id(model_.get(), mjOBJ_BODY, m.bodies[scene.journal()].name.c_str());
    sleeve_ = mj_name2id(model_.get(), mjOBJ_BODY, m.bodies[scene.sleeve()].name.c_str());
    pointing_ = mj_name2id(model_.get(), mjOBJ_BODY, m.bodies[scene.mechanism().boresight_body()].name.c_str());
  }

  PeerMotion follow() {
    const double duration = request_.duration > 0.0 ? request_.duration : scene_.duration();
    const long steps = std::lround(std::ceil(duration / request_.setting.step - 1e-9));
    model_->opt.timestep = duration / static_cast<double>(steps);
    const double start = thread_cpu_seconds();
    mju_user_warning = [](const char*) {};  // it would write them to a file of its own; follow() says what went wrong
    current_ = this;
    mjcb_passive = [](const mjModel*, mjData*) { current_->passive_forces(); };
    for (long k = 0; k < steps; ++k) {
      kept_ = true;
      mj_step(model_.get(), data_.get());
      data_->time = duration * static_cast<double>(k + 1) / static_cast<double>(steps);
      for (const Drive& d : driven_) {
        const TimeValue& law = drives_.at(data_->time, d.joint);
        data_->qpos[d.q] = law.value;
        data_->qvel[d.v] = law.rate;
      }
      if (data_->warning[mjWARN_BADQACC].number + data_->warning[mjWARN_BADQPOS].number +
          data_->warning[mjWARN_BADQVEL].number)
        fail("diverges at t = " + std::to_string(data_->time) + " s of the motion");
      if (k % 256 == 0 && thread_cpu_seconds() - start > request_.most_seconds)
        fail("given up at t = " + std::to_string(data_->time) + " s of the motion");
    }
    kept_ = true;
    mj_forward(model_.get(), data_.get());
    mjcb_passive = nullptr;
    out_.cpu_seconds = thread_cpu_seconds() - start;
    const IndexWatch::Result error = index_.result();
    out_.largest = error.max;
    out_.rms = error.rms;
    out_.steps = steps;
    out_.evaluations = contact_.evaluations();
    out_.first_contact = contact_.first_contact();
    return out_;
  }

 private:
  struct Drive {
    int joint, q, v;
  };
  [[noreturn]] static void fail(const std::string& why) {
    mjcb_passive = nullptr;
    throw PeerFailure(why);
  }

  void read(int body, BodyMotion& out) const {
    mjtNum velocity[6];
    mj_objectVelocity(model_.get(), data_.get(), mjOBJ_XBODY, body, velocity, 0);
    out.p = Eigen::Map<const Vec3>(data_->xpos + 3 * body);
    out.R = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(data_->xmat + 9 * body);
    out.w = Eigen::Map<const Vec3>(velocity);
    out.v = Eigen::Map<const Vec3>(velocity + 3);
  }

  // Called for every right-hand side; the first one of a step sees the state that the step before has left.
  void passive_forces() {
    mjData* d = data_.get();
    for (const Drive& drive : driven_)
      d->qfrc_passive[drive.v] += kArmature * drives_.at(d->time, drive.joint).acceleration;
    read(journal_, contact_.journal());
    read(sleeve_, contact_.sleeve());
    if (kept_) {
      kept_ = false;
      contact_.accept(d->time);
      const Vec3 p = Eigen::Map<const Vec3>(d->xpos + 3 * pointing_);
      index_.accept(d->time, p);
      if (request_.keep_path)
        out_.path.push_back(
            {d->time, p, Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(d->xmat + 9 * pointing_)});
    }
    if (!request_.with_clearance) return;
    Vec6 on_journal, on_sleeve;
    contact_.forces(d->time, on_journal, on_sleeve);
    if (on_journal.isZero(0.0)) return;
    mj_applyFT(model_.get(), d, on_journal.data(), on_journal.data() + 3, contact_.journal().p.data(), journal_,
               d->qfrc_passive);
    mj_applyFT(model_.get(), d, on_sleeve.data(), on_sleeve.data() + 3, contact_.sleeve().p.data(), sleeve_,
               d->qfrc_passive);
  }

  struct Delete {
    void operator()(mjModel* m) const { mj_deleteModel(m); }
    void operator()(mjData* d) const { mj_deleteData(d); }
  };
  inline static Run* current_ = nullptr;  // MuJoCo's callbacks are global

  const PeerScene& scene_;
  const PeerRequest& request_;
  Drives drives_;
  PeerContact contact_;
  IndexWatch index_;
  std::unique_ptr<mjModel, Delete> model_;
  std::unique_ptr<mjData, Delete> data_;
  std::vector<Drive> driven_;
  int journal_ = 0, sleeve_ = 0, pointing_ = 0;
  bool kept_ = false;
  PeerMotion out_;
};

class MujocoPeer final : public Peer {
 public:
  std::string name() const override { return std::string("MuJoCo ") + mj_versionString(); }
  std::string models() const override {
    return "A grain of 1 g on three slides carries the clearance, loops closed by pairs of connects, drives "
           "with armature, the "
           "contact as a passive force; constraints made 10,000 times stiffer than they come.";
  }
  bool stands_alone() const override { return true; }
  std::vector<PeerSetting> settings() const override {
    std::vector<PeerSetting> all;
    for (const char* method : {"RK4", "implicit", "Euler"})
      for (double step : {4e-4, 2e-4, 1e-4, 5e-5, 2.5e-5}) all.push_back({method, step, 0.0});
    return all;
  }
  PeerSetting proving_setting() const override { return {"RK4", 2.5e-5, 0.0}; }
  PeerMotion follow(const PeerScene& scene, const PeerRequest& request) const override {
    return Run(scene, request).follow();
  }
};

}  // namespace

std::unique_ptr<Peer> make_mujoco_peer() { return std::make_unique<MujocoPeer>(); }

}  // namespace boresight::peers
