// The parts that the reports of several verbs are made of: motion against the ideal one, pointing errors,
// contacts, provenance.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight/rungs/run_result.hpp"
#include "boresight_analyses/study/index_choice.hpp"
#include "boresight_analyses/study/rung_choice.hpp"
#include "command_line/command.hpp"
#include "report/document.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {

// One motion among those drawn over one another.
struct Overlay {
  std::string name;  // "0.1 mm"
  const RunResult* result = nullptr;
  std::function<std::string(const IndexChoice&)> stated =
      {};  // "± 2.3 %" of an index, or nothing; none: nobody measured
};

// Curves keep about this many points each; spikes are never lost (report::thinned).
inline constexpr std::size_t kPointsPerCurve = 1500;

// Errors below this, of the size of the mechanism [m] or as an angle ("rad"), are what the computation rounds; a chart would show noise as a
// result. Of a mechanism with neither play nor errors they are what the integration leaves of its ideal motion, which is more.
double rounding_of(const Mechanism& mechanism, const std::string& si_unit);

// The twelve panels of Sun et al. Fig. 6: position (their displacement), Z-Y-X Euler angles from home, acceleration and
// angular acceleration of the boresight body, each against the ideal motion.
report::Panels motion_panels(const Mechanism& mechanism, const std::vector<Overlay>& overlays,
                             const std::string& caption);

// What the eye cannot see in the twelve panels: the difference from the ideal motion, per axis.
report::Panels difference_panels(const Mechanism& mechanism, const std::vector<Overlay>& overlays);

// The size of the four errors over time.
report::Panels error_panels(const Mechanism& mechanism, const std::vector<Overlay>& overlays);

// The four indices with their statistics, one table per overlay row.
report::Table index_table(const std::vector<Overlay>& overlays);

// Contact statistics, one row per overlay and clearance joint.
report::Table contact_table(const std::vector<Overlay>& overlays);

// Whether a joint with play is a ball in its socket.
bool is_ball(const Mechanism& mechanism, int clearance);
// Whether it is a pad in its slot.
bool is_pad(const Mechanism& mechanism, int clearance);
// Whether it is a slider in a rectangular guide.
bool is_slider(const Mechanism& mechanism, int clearance);

// Whether what plays in it may tilt: it then touches with its edge before its centre is as far off as the gap is wide.
bool may_tilt(const Mechanism& mechanism, int clearance);

// The journal's centre in the sleeve or the ball's in its socket, seen along the axis, with the circle at which contact begins where
// axes are parallel.
report::Chart orbit_chart(const std::string& joint, bool ball, bool tilts, double radial_clearance,
                          const RunResult& result, std::size_t clearance);
// The same of a slider, with the rectangle that its guide leaves it.
report::Chart guide_chart(const std::string& joint, const ClearanceParameters& play, const RunResult& result,
                          std::size_t clearance);

// Free, radial, axial, both: along time, one row per clearance joint.
report::Strip contact_strip(const Mechanism& mechanism, const RunResult& result);

// A curve of one number per sample; `per_si` turns it into the axis' unit.
report::Series curve(const std::string& name, const std::vector<double>& time, const std::vector<double>& si_values,
                     double per_si);

// Version, mechanism, hash, settings, rung, command.
std::vector<report::Provenance> provenance_of(const Command& command, const Mechanism& mechanism,
                                              const RungChoice& rung);

// Z-Y-X Euler angles (about x, y, z) of the turn from home, continuous in time [rad].
std::vector<Vec3> euler_angles(const std::vector<Quat>& orientations, const Mat3& home);

}  // namespace boresight::app
