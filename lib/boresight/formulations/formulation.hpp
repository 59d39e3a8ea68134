// The seam between the multibody rung and the ways to write its equations of motion. A formulation turns a state into its
// rate; the rung steps it, keeps the contacts' memory, and records. Two formulations share nothing but the force elements,
// so that they check each other.
//
// One object serves one run: it holds work space and is not shared between threads.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "boresight/formulations/force_elements.hpp"
#include "boresight/mechanism/ideal_motion.hpp"

namespace boresight {

class Formulation {
 public:
  virtual ~Formulation() = default;

  virtual int state_size() const = 0;
  // Whether number k of the state is a speed.
  virtual bool is_speed(int k) const = 0;
  // Whether it is a displacement (or the speed of one), in metres, and no turn.
  virtual bool is_length(int k) const = 0;
  // Whether the state is (q, v) with q' = v: no quaternions.
  virtual bool positions_follow_speeds() const = 0;
  // The state of the ideal mechanism at its start: journals concentric, velocities of the ideal motion.
  virtual void start(const IdealState& ideal, VecX& y) = 0;
  // The state in which the bodies are where, and move as, they do: after start(), for bodies a little off it.
  virtual void place_bodies(const std::vector<BodyMotion>& bodies, VecX& y) = 0;
  // Closes all joints, in positions and speeds, along the shortest way and whatever the stabilisation.
  virtual void close_joints(double t, VecX& y) = 0;
  // dy = f(t, y). Allocates nothing. Throws ComputationError at a singular pose.
  virtual void derivative(double t, const VecX& y, const std::vector<ContactMemory>& memory, VecX& dy) = 0;
  // After an accepted step: whatever keeps the state on its constraints (normalised quaternions, projection).
  virtual void stabilise(double t, VecX& y) = 0;
  // Poses and velocities of all bodies at a state. The reference holds until the next call of anything here.
  virtual const std::vector<BodyMotion>& bodies(double t, const VecX& y) = 0;
  // Of the last derivative(): accelerations of all bodies; largest violated position constraint [m or rad].
  virtual const std::vector<BodyAcceleration>& acceleration() const = 0;
  virtual double violation() const = 0;
  // Of the last derivative(): what the reactions do where the rows of joints are opening [W]; 0 on an exact motion.
  double opening_power() const { return opening_power_; }
  // What unit forces on the journals (at their centres, and couples on their slopes) accelerate the offsets by, in the order
  // of OffsetLayout, symmetric [1/kg; with slopes 1/(kg m), 1/(kg m^2)], at the state of the last derivative().
  virtual MatX offset_compliance() = 0;
  // Kinetic plus gravitational plus elastic energy at a state [J].
  virtual double energy(double t, const VecX& y) = 0;

  const ForceElements& forces() const { return forces_; }
  ForceElements& forces() { return forces_; }

 protected:
  Formulation(const Mechanism& mechanism, const Parameters& parameters, bool with_clearance)
      : forces_(mechanism, parameters, with_clearance) {}
  ForceElements forces_;
  double opening_power_ = 0.0;
};

enum class Stabilisation { baumgarte, projection };

struct PaperFormulationOptions {
  bool with_clearance = true;
  Stabilisation stabilisation = Stabilisation::baumgarte;
  double alpha = 40.0, beta = 50.0;  // Baumgarte's gains [1/s], Eq. 43
};

// Absolute coordinates and Lagrange multipliers, as in the paper: see paper.cpp.
std::unique_ptr<Formulation> make_paper_formulation(const Mechanism& mechanism, const Parameters& parameters,
                                                    const IdealMotion* drives, const PaperFormulationOptions& options);

struct TreeFormulationOptions {
  bool with_clearance = true;
  Stabilisation stabilisation = Stabilisation::projection;
  double alpha = 40.0, beta = 50.0;  // Baumgarte's gains [1/s]
};

// Joint coordinates over a spanning tree, driven ones eliminated: see tree.cpp.
std::unique_ptr<Formulation> make_tree_formulation(const Mechanism& mechanism, const Parameters& parameters,
                                                   const IdealMotion* drives, const TreeFormulationOptions& options);

}  // namespace boresight
