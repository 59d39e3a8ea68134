#include "peer_proof.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/ladder/ladder.hpp"

namespace boresight::peers {
namespace {

// Our flight, sampled so densely that Hermite's cubic between samples is exact to rounding.
struct FreeFlight {
  std::vector<double> t;
  std::vector<Vec3> p, v;
  double first_contact = -1.0;

  Vec3 at(double time) const {
    const std::size_t k =
        std::clamp<std::size_t>(static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), time) - t.begin()), 1,
                                t.size() - 1) -
        1;
    const double h = t[k + 1] - t[k], s = (time - t[k]) / h, r = 1.0 - s;
    return r * r * (1.0 + 2.0 * s) * p[k] + s * s * (1.0 + 2.0 * r) * p[k + 1] + h * s * r * (r * v[k] - s * v[k + 1]);
  }
};

FreeFlight our_flight(const PeerScene& scene) {
  const auto multibody = make_rung("multibody", std::make_shared<const Mechanism>(scene.description()));
  RunOptions options;
  options.step = options.sample_spacing = 1e-5;
  long looks = 0;
  options.progress = [&](const RunProgress&) { return ++looks < 4; };  // every 256 steps
  const RunResult run = multibody->run(scene.parameters(), options);
  FreeFlight flight;
  flight.t = run.time;
  for (const PoseSample& s : run.boresight.samples) {
    flight.p.push_back(s.pose.p);
    flight.v.push_back(s.v);
  }
  if (!run.events.empty()) flight.first_contact = run.events.front().start;
  return flight;
}

}  // namespace

PeerProof prove(const Peer& peer, const PeerScene& scene, const PeerSetting& setting) {
  PeerProof proof;
  const int body = scene.mechanism().boresight_body();
  try {
    const PeerMotion closed = peer.follow(scene, {.setting = setting, .with_clearance = false, .keep_path = true});
    for (const PeerPose& pose : closed.path) {
      const BodyMotion ideal = scene.ideal().body(pose.t, body);
      proof.from_ideal = std::max(proof.from_ideal, (pose.p - ideal.p).norm());
      proof.turn_from_ideal = std::max(proof.turn_from_ideal, Eigen::AngleAxisd(pose.R * ideal.R.transpose()).angle());
    }
  } catch (const NoIdealMotion&) {
    proof.has_ideal = false;
  }
  const FreeFlight ours = our_flight(scene);
  proof.our_first_contact = ours.first_contact;
  const PeerMotion open =
      peer.follow(scene, {.setting = setting, .duration = 1.5 * ours.first_contact, .keep_path = true});
  proof.first_contact = open.first_contact;
  for (const PeerPose& pose : open.path)
    if (pose.t < std::min(ours.first_contact, open.first_contact))
      proof.flight_difference = std::max(proof.flight_difference, (pose.p - ours.at(pose.t)).norm());
  return proof;
}

}  // namespace boresight::peers
