#include "peer_scene.hpp"

#include <algorithm>
#include <stdexcept>

#include "boresight/contact_events/contact_tracker.hpp"
#include "boresight/formulations/force_elements.hpp"
#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/pointing/indices.hpp"

namespace boresight::peers {
namespace {

const std::string& clearance_joint_name(const MechanismDescription& m) {
  return m.joints[m.clearances.front().joint].name;
}

}  // namespace

PeerScene::PeerScene(std::shared_ptr<const Mechanism> mechanism, const Parameters& parameters)
    : mechanism_(std::move(mechanism)),
      parameters_(parameters),
      ideal_(ideal_motion(*mechanism_, parameters)),
      mass_(mechanism_->mass_properties(parameters)) {
  const MechanismDescription& m = description();
  if (m.clearances.size() != 1 || m.clearances[0].axes != JournalAxes::parallel ||
      m.joints[clearance_joint()].type != JointType::revolute || !m.springs.empty() || !m.loads.empty() ||
      !is_kinematic(*mechanism_))
    throw std::invalid_argument(
        "peers follow driven mechanisms with one clearance, in a revolute joint, axes parallel");
  ideal_.state(0.0, start_);
  for (int b = 0; b < mechanism_->bodies(); ++b)
    if ((start_.bodies[b].p - m.bodies[b].center_of_mass).norm() > 1e-9 ||
        (start_.bodies[b].R - m.bodies[b].axes).norm() > 1e-9)
      throw std::invalid_argument("peers start from the home pose, and " + m.bodies[b].name + " does not");

  // Bodies as far from the ground as they are; a body is hung on the last leg that reaches it, so that the
  // clearance joint, in the first, never carries.
  std::vector<bool> carried(mechanism_->bodies(), false), used(mechanism_->joints(), false);
  used[clearance_joint()] = true;
  for (bool grown = true; grown;) {
    grown = false;
    for (int j = 0; j < mechanism_->joints(); ++j) {
      const JointDescription& d = m.joints[j];
      if (used[j] || !(d.first == kGround || carried[d.first]) || carried[d.second]) continue;
      tree_.push_back({j, d.first, d.second});
      carried[d.second] = used[j] = grown = true;
    }
  }
  for (int j = 0; j < mechanism_->joints(); ++j)
    if (!used[j]) loops_.push_back(j);
  if (std::find(carried.begin(), carried.end(), false) != carried.end())
    throw std::invalid_argument("peers need joints that go from carrying to carried body");
}

int PeerScene::sleeve() const {
  const JointDescription& j = description().joints[clearance_joint()];
  return j.first == journal() ? j.second : j.first;
}

double PeerScene::turning_rate(int joint) const {
  const JointDescription& j = description().joints[joint];
  const Vec3 w = start_.bodies[j.second].w - (j.first == kGround ? Vec3::Zero().eval() : start_.bodies[j.first].w);
  return w.dot(j.axis);
}

double PeerScene::sliding_rate(int joint) const {
  const JointDescription& j = description().joints[joint];
  const auto velocity = [&](int body) -> Vec3 {
    if (body == kGround) return Vec3::Zero();
    const BodyMotion& b = start_.bodies[body];
    return b.v + b.w.cross(j.point - b.p);
  };
  return (velocity(j.second) - velocity(j.first)).dot(j.axis);
}

struct PeerContact::Laws {
  explicit Laws(const PeerScene& scene)
      : elements(scene.mechanism(), scene.parameters(), true),
        tracker(0, clearance_joint_name(scene.description()), elements.joint(0), true),
        bodies(scene.mechanism().bodies()),
        memory{tracker.memory()},
        wrench(scene.mechanism().bodies()),
        journal(scene.journal()),
        sleeve(scene.sleeve()) {}
  ForceElements elements;
  ContactTracker tracker;
  std::vector<BodyMotion> bodies;
  std::vector<ContactMemory> memory;
  std::vector<Vec6> wrench;
  std::array<ContactState<double>, kContactPlaces> contact;
  int journal, sleeve;
};

PeerContact::PeerContact(const PeerScene& scene)
    : laws_(std::make_unique<Laws>(scene)),
      journal_(&laws_->bodies[scene.journal()]),
      sleeve_(&laws_->bodies[scene.sleeve()]) {}
PeerContact::~PeerContact() = default;

void PeerContact::forces(double t, Vec6& on_journal, Vec6& on_sleeve) {
  Laws& l = *laws_;
  l.wrench[l.journal].setZero();
  l.wrench[l.sleeve].setZero();
  l.elements.apply(t, l.bodies, l.memory, l.wrench);
  on_journal = l.wrench[l.journal];
  on_sleeve = l.wrench[l.sleeve];
  ++evaluations_;
}

void PeerContact::accept(double t) {
  Laws& l = *laws_;
  l.elements.joint(0).penetrations(l.elements.play_motion(0, l.bodies), l.contact);
  l.tracker.accept(t, l.contact);
  l.memory[0] = l.tracker.memory();
  if (first_contact_ < 0.0 && l.tracker.touching()) first_contact_ = t;
}

struct IndexWatch::Gathered {
  const PeerScene& scene;
  int body;
  StatisticsOverTime error = StatisticsOverTime();
};
IndexWatch::IndexWatch(const PeerScene& scene)
    : gathered_(std::make_unique<Gathered>(Gathered{scene, scene.mechanism().boresight_body()})) {}
IndexWatch::~IndexWatch() = default;
void IndexWatch::accept(double t, const Vec3& p) {
  gathered_->error.add(t, (p - gathered_->scene.ideal().body(t, gathered_->body).p).norm());
}
IndexWatch::Result IndexWatch::result() const {
  const Statistics error = gathered_->error.result();
  return {error.max, error.rms};
}

}  // namespace boresight::peers
