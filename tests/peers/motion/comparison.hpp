// Our rungs and every peer on one scene, in one run, on one machine: error of the index against CPU time.
//
//   Comparison all = compare(mechanism, mechanism->parameters(), {});
//   all.cheapest_within(0.01, [](const ComparedPoint& p) { return p.stands_alone; });
#pragma once

#include <functional>

#include "boresight_analyses/chart/machine.hpp"
#include "boresight_analyses/chart/reference.hpp"
#include "peer_proof.hpp"

namespace boresight::peers {

struct ComparedPoint {
  std::string program;  // "multibody", "perturbation", "perturbation on lanes", "MuJoCo 2.2.2", ...
  std::string setup;    // the rest of what tells one line of the chart from another
  std::string fineness;
  bool ours = false;
  bool stands_alone = false;  // a whole program, not an integrator on our right-hand side
  Measurement measured;
  double error = 0.0;  // relative, of the index; see relative_error

  std::string line() const { return setup.empty() ? program : program + ", " + setup; }
  bool done() const { return measured.refusal.empty(); }
};

struct ProvedPeer {
  std::string name, models, setting;
  PeerProof proof;
};

struct Comparison {
  Reference reference;
  std::vector<ProvedPeer> proofs;
  std::vector<ComparedPoint> points;  // line by line, coarse to fine; those that failed too
  Machine machine;

  // Null if none of those wanted comes within it.
  const ComparedPoint* cheapest_within(double accuracy, const std::function<bool(const ComparedPoint&)>& wanted) const;
};

struct ComparisonOptions {
  double most_seconds = 8.0;  // of CPU for one run, beyond which it is given up
  std::function<void(const std::string&)> progress = [](const std::string&) {};
};

Comparison compare(const std::shared_ptr<const Mechanism>& mechanism, const Parameters& parameters,
                   const ComparisonOptions& options);

}  // namespace boresight::peers
