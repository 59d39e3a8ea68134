// A program that is held beside ours on one scene: what it is asked, and what it hands back.
//
//   PeerScene scene(mechanism, mechanism->parameters());
//   for (const auto& peer : peers()) peer->follow(scene, {.setting = peer->settings().front()});
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "boresight/math/types.hpp"
#include "peer_scene.hpp"

namespace boresight::peers {

// One integrator of a program, and how finely it goes: a step [s], or what the program calls accuracy or
// tolerance [-].
struct PeerSetting {
  std::string method;
  double step = 0.0, accuracy = 0.0;

  // "h = 50 us", "accuracy 1e-4"
  std::string fineness() const;
  // A neighbour, as fine as this one but for chance.
  PeerSetting scaled(double share) const { return {method, share * step, share * accuracy}; }
};

struct PeerRequest {
  PeerSetting setting;
  double duration = 0.0;       // [s]; 0: the whole motion
  bool with_clearance = true;  // false: the joint is ideal
  bool keep_path = false;      // fill PeerMotion::path
  double most_seconds = 1e9;   // of CPU, beyond which it gives up (PeerFailure)
};

struct PeerPose {
  double t = 0.0;  // [s]
  Vec3 p = Vec3::Zero();
  Mat3 R = Mat3::Identity();  // of the boresight body
};

struct PeerMotion {
  double largest = 0.0, rms = 0.0;  // of the position error [m]
  double first_contact = -1.0;      // [s], to a step; negative: none
  long steps = 0,
       evaluations = 0;        // evaluations: of the contact force, which every right-hand side asks for once
  double cpu_seconds = 0.0;    // of the motion alone: what is built once for a mechanism is not counted
  std::vector<PeerPose> path;  // at every step
};

struct PeerFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Asked for the motion without clearance, of which it has none.
struct NoIdealMotion : PeerFailure {
  using PeerFailure::PeerFailure;
};

class Peer {
 public:
  virtual ~Peer() = default;
  virtual std::string name() const = 0;    // with its version
  virtual std::string models() const = 0;  // how the scene is written in it, in one sentence
  virtual bool stands_alone() const = 0;   // false: an integrator on our right-hand side
  // Its integrators, each from coarse to fine.
  virtual std::vector<PeerSetting> settings() const = 0;
  // Fine enough to show what it models.
  virtual PeerSetting proving_setting() const = 0;
  // Throws PeerFailure where it cannot follow the motion.
  virtual PeerMotion follow(const PeerScene& scene, const PeerRequest& request) const = 0;
};

// Those this build has, whatever is missing left out.
std::vector<std::unique_ptr<Peer>> peers();

std::unique_ptr<Peer> make_simbody_peer();
std::unique_ptr<Peer> make_mujoco_peer();
// On the right-hand side of multibody, and on that of the perturbation rung.
std::unique_ptr<Peer> make_sundials_multibody_peer();
std::unique_ptr<Peer> make_sundials_perturbation_peer();

}  // namespace boresight::peers
