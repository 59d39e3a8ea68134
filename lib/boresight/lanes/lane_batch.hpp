// What goes into the lane integrator and what comes out: plain numbers only, shared by the code of every instruction set.
#pragma once

#include <atomic>
#include <type_traits>

#include "boresight/integrate/rosenbrock_tables.hpp"
#include "boresight/play/joint_play.hpp"
#include "boresight/scene/scene_layout.hpp"

namespace boresight {

// The contacts that one joint can have.
struct LanePlaces {
  int count = 0;
  ContactPlace place[kContactPlaces] = {};
  const ContactPlace* begin() const { return place; }
  const ContactPlace* end() const { return place + count; }
};

// The functions of time of one scene and one set of masses (SceneTables), with the gain of the index behind them.
struct LaneScene {
  const SceneLayout* layout = nullptr;
  // Accelerations where the layout is one that kernels know when compiling (SingleRevoluteLayout), forces elsewhere.
  SceneForm form = SceneForm::accelerations;
  const double* in_double = nullptr;  // [cell][power 0..3][width]: cubics in s, 0 <= s <= 1 across a cell
  const float* in_single = nullptr;   // the same rounded
  int cells = 0;
  int width = 0;                       // columns, padded to whole registers
  int gain = 0;                        // first column of G (3 x n, row by row): the index is |G z|
  double per_spacing = 0.0;            // cells a second
  double duration = 0.0;               // [s]
  const LanePlaces* places = nullptr;  // per clearance

  template <typename Real>
  const Real* coefficients() const {
    if constexpr (std::is_same_v<Real, float>)
      return in_single;
    else
      return in_double;
  }
};

// Functions of one sample's own, cubics between knots at equal distances.
struct LaneCourses {
  const double* knots = nullptr;  // [knot][2 count]: values, then slopes times the spacing; null: all are zero
  int cells = 0;                  // between the knots
  double per_spacing = 0.0;       // cells a second
};

// What one sample's standing errors add over time.
struct LaneStanding {
  LaneCourses index;            // three numbers
  LaneCourses loads;            // n: to what the scene's rows say of r
  double longest_step = 1e300;  // across which a parabola still follows them [s]
};

struct LaneJob {
  const LaneScene* scene = nullptr;
  const JointPlay* joints = nullptr;      // one per clearance
  const double* tolerance = nullptr;      // 2 n: largest error of one step, of each z, then of each zdot
  const double* start = nullptr;          // 2n: z and zdot at the start; zero where none is given
  const double* gap_tolerance = nullptr;  // one per clearance [m]: a contact begins this close to its located start
  LaneStanding standing = {};
};

enum class LaneStatus { done, step_too_small, too_many_steps, not_reached };  // not_reached: stopped before its end

struct LaneOutcome {
  LaneStatus status = LaneStatus::done;
  double t = 0.0;  // reached [s]
  // Of the index over time, from LaneSettings::start on.
  double max = 0.0, time_of_max = 0.0, mean = 0.0, mean_square = 0.0;
  double max_of_play = 0.0;  // the largest without what standing errors add, at the ends of steps of the whole motion
  double free_flight_share = 0.0;  // of that time, of the joint least in contact
  long impacts = 0;                // contacts begun in it
  double touching_time = 0.0;      // with any contact [s]
  double max_penetration = 0.0;    // [m]
  long steps = 0, rejected = 0;    // rejected: by the error, or cut at the start of a contact
};

struct LaneSettings {
  double start = 0.0;  // [s]: of the statistics of the index
  const RosenbrockTable* method = nullptr;
  double longest_step = 4e-3;       // [s]: the scene's numbers are taken as straight lines across a step
  double longest_held_step = 1e-3;  // [s]: where the scene's matrices are held still over a step
  double first_step = 1e-6;         // [s]
  double smallest_step = 1e-13;     // [s]
  long most_steps = 10'000'000;
  const std::atomic<bool>* stop = nullptr;  // once it is set, the kernel leaves soon
  // Called as each job ends, in the order in which they end. attempts: those made so far, of all lanes together.
  void (*ended)(void* listener, long job, double attempts) = nullptr;
  void* listener = nullptr;
};

// Integrates jobs[0 .. count): as many at once as the register has lanes, each at its own time and step; a lane whose sample
// is done takes the next one. An outcome depends on its own job only, to the last bit.
using LaneKernel = void (*)(const LaneJob* jobs, long count, const LaneSettings& settings, LaneOutcome* outcomes);

}  // namespace boresight
