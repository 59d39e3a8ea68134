// What every program is given: the mechanism as a file describes it, its drives, and the contact of its one
// clearance joint.
//
// A peer brings its own bodies, joints, constraints and integrators. The contact law is no part of what is
// compared: each has it as its own users would add it, as a force of theirs that calls the one copy of the
// law.
//
// In C++17, as Simbody's headers must be.
#pragma once

#include <memory>
#include <vector>

#include "boresight/mechanism/ideal_motion.hpp"
#include "boresight/mechanism/mechanism.hpp"

namespace boresight::peers {

// A mechanism that starts from its home pose, driven throughout, with one clearance in a revolute joint, axes
// parallel.
class PeerScene {
 public:
  // Throws std::invalid_argument for any other.
  PeerScene(std::shared_ptr<const Mechanism> mechanism, const Parameters& parameters);

  const Mechanism& mechanism() const { return *mechanism_; }
  const MechanismDescription& description() const { return mechanism_->description(); }
  const Parameters& parameters() const { return parameters_; }
  const IdealMotion& ideal() const { return ideal_; }
  const IdealState& start() const { return start_; }
  const std::vector<MassProperties>& mass() const { return mass_; }
  double duration() const { return mechanism_->duration(); }

  int clearance_joint() const { return description().clearances.front().joint; }
  int journal() const { return description().clearances.front().journal; }
  int sleeve() const;  // the body that carries it

  // Joints in an order in which each body's first joint comes after the one that carries its neighbour; the
  // clearance joint and those that would close a loop are left out.
  struct TreeJoint {
    int joint, parent, child;
  };
  const std::vector<TreeJoint>& tree() const { return tree_; }
  const std::vector<int>& loops() const { return loops_; }  // joints left out, the clearance joint excepted

  // Of a joint's freedoms at the start: [rad/s], [m/s].
  double turning_rate(int joint) const;
  double sliding_rate(int joint) const;

 private:
  std::shared_ptr<const Mechanism> mechanism_;
  Parameters parameters_;
  IdealMotion ideal_;
  IdealState start_;
  std::vector<MassProperties> mass_;
  std::vector<TreeJoint> tree_;
  std::vector<int> loops_;
};

// The laws of the drives; asked for value, rate and acceleration of several joints at one time, it works them
// out once.
class Drives {
 public:
  explicit Drives(const PeerScene& scene) : ideal_(scene.ideal()), laws_(scene.mechanism().joints()) {}
  const TimeValue& at(double t, int joint) {
    if (t != t_) ideal_.drive_laws(t_ = t, laws_);
    return laws_[joint];
  }

 private:
  const IdealMotion& ideal_;
  std::vector<TimeValue> laws_;
  double t_ = -1.0;
};

// The force between journal and sleeve of one run, and the memory of its impacts.
class PeerContact {
 public:
  explicit PeerContact(const PeerScene& scene);
  ~PeerContact();

  // Where a program writes the motion of the two bodies before it asks.
  BodyMotion& journal() { return *journal_; }
  BodyMotion& sleeve() { return *sleeve_; }

  // Wrenches on both: force, then moment about the body's own centre of mass, world axes. Zero while they are
  // apart.
  void forces(double t, Vec6& on_journal, Vec6& on_sleeve);
  // After a step that the program keeps: latches impact speeds, as our fixed steps do.
  void accept(double t);

  long evaluations() const { return evaluations_; }
  double first_contact() const { return first_contact_; }  // [s]; negative: none

 private:
  struct Laws;
  std::unique_ptr<Laws> laws_;
  BodyMotion *journal_, *sleeve_;
  long evaluations_ = 0;
  double first_contact_ = -1.0;
};

// The index over the states that a program keeps, weighed as our rungs do.
class IndexWatch {
 public:
  explicit IndexWatch(const PeerScene& scene);
  ~IndexWatch();
  void accept(double t, const Vec3& p);

  struct Result {
    double max = 0.0, rms = 0.0;  // [m]
  };
  Result result() const;

 private:
  struct Gathered;
  std::unique_ptr<Gathered> gathered_;
};

}  // namespace boresight::peers
