// The forces between bodies that are not constraints: springs, loads, and the contacts of the clearance joints.
// Shared by all multibody formulations: each hands over where the bodies are and takes back a wrench per body.
#pragma once

#include <vector>

#include "boresight/mechanism/body_motion.hpp"
#include "boresight/mechanism/mechanism.hpp"
#include "boresight/play/joint_play.hpp"

namespace boresight {

class ForceElements {
 public:
  // with_clearance: false for the mechanism with ideal joints.
  ForceElements(const Mechanism& mechanism, const Parameters& parameters, bool with_clearance);

  // Adds to wrench, per body: force, then moment about the body's own centre of mass, world axes.
  void apply(double t, const std::vector<BodyMotion>& bodies, const std::vector<ContactMemory>& memory,
             std::vector<Vec6>& wrench);

  // In place of contact, from now on: constant loads on the journals' offsets (sleeve axes, in the order x y z of the centre,
  // then couples on the slopes), one per clearance [N, N m].
  void replace_contact(std::vector<PlayOffsets> loads) { held_ = std::move(loads); }

  // The contacts' wrenches as they stand, whatever the motion: for derivatives of everything but the contact laws.
  void hold_contact(bool hold) { hold_ = hold; }
  PlayWrench<double>& contact(int clearance) { return joints_[clearance].wrench; }

  // Elastic energy of springs and contacts [J].
  double elastic_energy(const std::vector<BodyMotion>& bodies) const;

  int clearances() const { return static_cast<int>(joints_.size()); }
  const JointPlay& joint(int clearance) const { return joints_[clearance].law; }
  // The law that acts from now on: that of the contacts that are closed (located_contacts.hpp).
  void act(int clearance, const JointPlay& law) { joints_[clearance].law = law; }
  PlayMotion<double> play_motion(int clearance, const std::vector<BodyMotion>& bodies) const;
  // Of the last apply().
  const PlayWrench<double>& contact(int clearance) const { return joints_[clearance].wrench; }
  const PlayMotion<double>& motion(int clearance) const { return joints_[clearance].motion; }
  const Bristles<double>& bristle_rate(int clearance) const { return joints_[clearance].bristle_rate; }

 private:
  struct Joint {
    JointPlay law;
    JointFrame sleeve, journal;
    PlayMotion<double> motion;
    PlayWrench<double> wrench;
    Bristles<double> bristle_rate{};
  };
  struct Spring {
    int first, second;
    Vec3 p_first, p_second;  // in body axes from the centre of mass (world for the ground)
    SpringParameters law;
  };

  void load(Joint& joint, const PlayOffsets& held) const;

  const Mechanism& mechanism_;
  bool hold_ = false;
  std::vector<Joint> joints_;
  std::vector<PlayOffsets> held_;
  std::vector<Spring> springs_;
  std::vector<Vec3> load_point_;  // of the description's loads at a point, body axes
};

}  // namespace boresight
