// The mechanism opened at its clearance joints, as smooth functions of time: what the cheap rungs compute with.
//
// Clearances are 1e-3 to 1e-4 of the link lengths, so the motion is the ideal one plus a deviation that is linear in a few
// coordinates z, the joints' offsets as far as these are free (DeviationCoordinates). With T the velocities of all bodies
// per unit rate of z,
//
//     M_r(t) zddot + C(t) zdot + K(t) z = r(t) + f_contact,    pose error of a body = E(t) z
//
//   M_r = T^T M T      C = T^T [M (2 Tdot - w x T) + gyroscopic]      r = T^T (Q - M vdot_ideal)      E = T's rows
//
// 2 Tdot is the Coriolis part (the offsets ride on moving bodies); - w x T stands in the turning rows only: with
// R = exp(theta) R_ideal the angular acceleration is alpha_ideal + thetaddot + thetadot x w_ideal to first order in theta.
// K, forces that change with the deviation itself. Springs and dampers bring theirs (spring_gains.hpp): k and what their pull does
// as it turns, and D in C. What gravity, inertia and loads add (their geometric stiffness) matters where the ideal mechanism has
// freedoms of its own (a pendulum): there alone it is kept, by differences of the multibody formulation. Between offsets held
// by contact it is to the contact forces as the offsets to the mechanism's size, and part of the model error (perturbation.cpp).
// Where redundant joints tie offsets together, which of them are coordinates is the drawing's choice, and must not matter: T^T [M T'' +
// (gyroscopic - w x) T'] is then kept, which says that it is the bodies' motion T z that has no force of its own, and not z.
// Where offsets are tied together besides, how contacts share the load decides what a tilt does to such a freedom: they are taken to share it
// as where the drawn journals rest (shared_stiffness.cpp).
// The generalised contact force of a joint is its whole wrench on the journal: the force along the offset, the moment
// through what z does to the relative spin, w_rel = w_ideal + S zdot (of a tilted journal, what the moment does along its own axis), and on a cylindrical joint the axial friction through what
// it does to the slide, s_ideal + Y z, and its rate, s_ideal' + Y zdot. Where a sleeve's ends push along a tilted journal is of second order in
// z, yet as large as the play where the sleeve is short. Contacts that turn with their
// insert about its axis (corners of a pad) lie where its twist takes them, that of the ideal motion and what z adds. Where T'' is kept so are S' z and Y' z. Of a contact's numbers none but the drawn ones changes any of this.
// Masses and gravity enter M_r, C and r affinely, so a payload, body-mass or gravity sweep needs no new scene (unless the ideal motion
// itself hangs on them).
// Derived for this program; held against the multibody rung in a test.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "boresight/math/time_table.hpp"
#include "boresight/scene/riding_masses.hpp"
#include "boresight/scene/scene_layout.hpp"
#include "boresight/scene/spring_gains.hpp"

namespace boresight {

class ExactStates;
struct Tipping;

// The scene as motions start: its numbers at t = 0 (a row of SceneTables::dynamics), and zdot per z there (start_rates.hpp).
struct SceneStart {
  std::vector<double> row;
  MatX rates;
  double cancelled = 0.0;  // a load below is what rounding leaves of loads that cancel [N]
  VecX beside = {};        // where journals rest: what motions start beside that balance, z, then zdot; empty: nothing
};

// The scene for one set of masses and one gravity, ready to integrate.
struct SceneTables {
  SceneLayout layout;
  // Per time, row by row: A = M_r^-1 (its upper triangle), A r, A C, (A K), then the joints' parts: see SceneLayout. As forces: M_r, r, C, (K).
  TimeTable dynamics;
  SceneStart start;
  // What one sample's standing errors add to A r, or to r: n functions on a grid of their own; none (width 0) without errors.
  TimeTable load_change = {};
  // What they shift each joint's offsets by that follow from others, then these shifts' rates, on a grid of their own: one a joint, of width 0
  // where none follow; empty without such errors.
  std::vector<TimeTable> shifts = {};
  // r, where A r is told and a freedom is not driven. A contact carries r: what is left of A r and A f, each between instants by its own cubic,
  // is some 1e-7 of either, which such a freedom would integrate twice. So A r is made of A and r then, and nothing is left.
  TimeTable reaction = {};

  // All numbers at t, those of the errors included: a row of dynamics.
  void at(double t, double* row) const;
};

class ClearanceScene {
 public:
  // accuracy: of the functions of time between the knots, relative to each group's largest value; the grid is refined until
  // it holds for gridded_by(parameters). Throws ComputationError, naming the time, where T does not exist: near a singular pose.
  // Where the ideal motion is simulated (freedoms that nothing drives) the scene holds for `parameters`' masses, gravity,
  // springs and loads only.
  ClearanceScene(const Mechanism& mechanism, const IdealMotion& ideal, const Parameters& parameters,
                 double accuracy = kAccuracy);
  static constexpr double kAccuracy = 2e-6;

  // The scene as motions start alone.
  struct Start {
    SceneLayout layout;
    SceneStart numbers;
    IdealState ideal;
    MatX T, T_rate;  // 6 bodies x n
  };
  static Start at_start(const Mechanism& mechanism, const IdealMotion& ideal, const Parameters& parameters);

  const DeviationCoordinates& coordinates() const { return coordinates_; }
  const OffsetLayout& offsets() const { return offsets_; }
  const SceneLayout& layout() const { return layout_; }
  int knots() const { return static_cast<int>(knots_.size()); }
  double spacing() const { return spacing_; }
  // Whose tables choose the grid of a scene made for these. One that serves other masses, gravity and springs too takes the drawing's, and
  // these' centres of mass alone: what a sample gets does not hang on which came first.
  Parameters gridded_by(const Parameters& parameters) const;
  // In which a load changes by all that it does [s]: load_time.hpp.
  double load_time() const { return load_time_; }

  SceneTables tables(const Parameters& parameters, SceneForm form = SceneForm::accelerations) const;
  // E of one body: 6 x n, row by row, over time.
  TimeTable pose_gain(int body) const;
  // Its rate of change, likewise.
  TimeTable pose_gain_rate(int body) const;
  // What springs oppose to z at a knot, of what lies still there: T^T K T, without the part of dampers whose stretch rate z changes. (Which z do
  // not change hangs on the coordinates: with that part alone, and not what z' adds, journals would rest elsewhere by others.)
  MatX stiffness_at_rest(const Parameters& parameters, int knot) const;
  // M_r, C and r of these parameters at a knot.
  void assemble(const Parameters& parameters, int knot, MatX& M, MatX& C, VecX& r) const;
  // E of the boresight body at a knot, 6 x n; offsets per coordinate there, B.
  MatX pose_gain_at(int knot) const { return knots_[knot].T.middleRows<6>(6 * mechanism_.boresight_body()); }
  // E of all bodies there, one below the other: 6 bodies x n.
  const MatX& pose_gains_at(int knot) const { return knots_[knot].T; }
  const MatX& offsets_per_coordinate(int knot) const { return knots_[knot].B; }
  // Whether loads tip journals that they push nowhere (tipping.hpp): then their own stiffness is kept, and the scene holds for `parameters`'
  // masses, gravity, springs and loads only.
  bool tips() const { return layout_.tips; }
  // Whether a scene of these parameters would tip, by the mechanism at t = 0 alone: to be asked before a scene that does not serves others.
  static bool would_tip(const Mechanism& mechanism, const IdealMotion& ideal, const Parameters& parameters);

 private:
  ClearanceScene(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal);  // without knots

  struct Knot {
    IdealState state;
    MatX T, T_rate, T_second, B;
    std::vector<double> joints;  // the joints' part of a row
    std::vector<double>
        elements;  // per element group: M (n n), C (n n), r (n), r per unit of gravity (n 3), (K of T'', n n)
    std::vector<SpringGain> springs;
    MatX stiffness;  // A K, where by differences
  };
  Knot knot_at(double t, const IdealMotion& ideal, ExactStates& exact, const Parameters& parameters);
  void add_joints(const MatX& B_rate, Knot& knot) const;
  void add_element(const RidingMass& element, const Knot& knot, double* out) const;
  void assemble(const Parameters& parameters, const Knot& knot, MatX& M, MatX& C, VecX& r) const;
  TimeTable reactions(const Parameters& parameters) const;
  // What springs and dampers oppose to z, with the part of dampers whose stretch rate z changes.
  MatX spring_stiffness(const Parameters& parameters, const Knot& knot) const;
  // What T'' takes, where offsets depend on others: a load on z of -K z.
  MatX moving_stiffness(const Parameters& parameters, const Knot& knot) const;
  MatX stiffness_at_rest(const Parameters& parameters, const Knot& knot) const;
  // What differences know of how the coordinates change along the motion, which does not push what lies still: what T'' takes, and dampers
  // whose stretch rate z changes.
  MatX changing_stiffness(const Parameters& parameters, const Knot& knot) const;
  // at_rest: for a balance of forces, which does not ask how the coordinates change.
  void append_row(const Parameters& parameters, const Knot& knot, std::vector<double>& row, bool at_rest = false,
                  SceneForm form = SceneForm::accelerations) const;
  // Where a freedom is not driven and offsets are tied together: takes A K anew at every knot, under the loads that contacts share out between
  // them where journals rest, if that is as smooth in time as a table asks for.
  void let_contacts_share(const Parameters& parameters, const IdealMotion& ideal, double most_missed);
  double slowest_rate(const std::vector<double>& rows, const Parameters& parameters) const;
  double interpolation_error(const std::vector<double>& rows, const Parameters& parameters) const;
  // Whose journals the loads of the motion tip over, and which nothing holds.
  Tipping tipped_by_all_loads(const IdealMotion& ideal, const Parameters& parameters);
  // A K by differences, of which all forces have their part.
  bool stiff_by_differences() const { return coordinates_.leftover() > 0 || layout_.tips; }
  // Whether T'' has a part.
  bool moving() const { return coordinates_.has_dependent(); }
  int element_size() const { return (moving() ? 3 : 2) * layout_.n * layout_.n + 4 * layout_.n; }

  const Mechanism& mechanism_;
  OffsetLayout offsets_;
  DeviationCoordinates coordinates_;
  SceneLayout layout_;
  std::vector<std::vector<RidingMass>> groups_;
  SceneStart start_of(const Parameters& parameters, const Knot& first) const;

  double spacing_ = 0.0;
  double load_time_ = std::numeric_limits<double>::infinity();
  std::vector<Knot> knots_;
};

}  // namespace boresight
