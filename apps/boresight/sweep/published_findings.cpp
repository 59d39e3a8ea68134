#include "sweep/published_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "boresight_analyses/sweep/paper_facts.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {
namespace {

using Verdict = PublishedFinding::Verdict;
using Findings = std::vector<PublishedFinding>;

Verdict agrees_if(bool condition) { return condition ? Verdict::agrees : Verdict::differs; }

std::vector<double> over(const SweepLine& line, const std::function<double(const RunResult&)>& value) {
  std::vector<double> values;
  for (const RunResult* result : line.results) values.push_back(value(*result));
  return values;
}

// "0.1 mm: 0.23 mm, 0.2 mm: 0.446 mm, ..."
std::string listed(const SweepLine& line, const std::vector<double>& values,
                   const std::function<std::string(double)>& text) {
  std::string list;
  for (std::size_t i = 0; i < line.size(); ++i)
    list += (i ? ", " : "") + readable_as(line.values[i], line.axis->si_unit, line.axis->unit) + ": " + text(values[i]);
  return list;
}
std::string listed(const SweepLine& line, const std::vector<double>& values, const std::string& si_unit) {
  return listed(line, values, [&](double v) { return readable(v, si_unit); });
}

double max_error(const RunResult& r) { return r.index.position_error.max; }
double rms_error(const RunResult& r) { return r.index.position_error.rms; }
double max_rotation(const RunResult& r) { return r.index.orientation_error.max; }

PublishedFinding orientation_untouched(const Mechanism& mechanism, const SweepLine& line, const std::string& what) {
  const bool none = orientation_stays(mechanism, line);
  return {fmt::format("The {} has a great influence on the linear displacement of the platform but little on "
                      "the angular displacement.",
                      what),
          agrees_if(none), "Largest orientation error: " + listed(line, over(line, max_rotation), "rad") + ".",
          parallel_axes(mechanism)
              ? "The three A drives alone fix the orientation, the three lengths the position. Journal and "
                "sleeve axes are assumed parallel, "
                "so F1 passes the torque of its drive whatever its offset: the angular error is zero by "
                "assumption, not by measurement. "
                "A journal that tilts (axes = \"free\") turns the platform by milliradians."
              : "Here the journal may tilt in its sleeve (axes = \"free\"). F1 is the only path by which "
                "drive A1 holds the orientation, so the tilt "
                "turns the platform: the paper's finding follows from its assumption that the axes stay "
                "parallel."};
}

PublishedFinding angular_acceleration(const Mechanism& mechanism, const SweepLine& line, const std::string& statement) {
  std::vector<double> disturbance;
  for (const RunResult* r : line.results) disturbance.push_back(angular_acceleration_disturbance(*r).value_or(0.0));
  const bool jumps = *std::max_element(disturbance.begin(), disturbance.end()) > 0.01;
  return {statement, agrees_if(jumps),
          "Largest departure of the angular acceleration from the ideal one, as a share of the largest ideal "
          "value: " +
              listed(line, disturbance,
                     [](double v) { return v < 1e-4 ? std::string("below 0.01 %") : readable_share(v); }) +
              ".",
          jumps || !parallel_axes(mechanism)
              ? "The orientation is no longer a function of the drives alone, so impacts reach the angular "
                "acceleration."
              : "With parallel axes the orientation is a function of the drives alone: its acceleration "
                "cannot jump while its angle stays the ideal one. "
                "Jumps beside unchanged angles must come from the computation; stabilisation terms that pull "
                "drifting constraints back would do it."};
}

// ---- clearance

PublishedFinding strongest_direction(const SweepLine& line) {
  const DisturbedDirections found = disturbed_directions(line);
  std::string axes;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec3& a = found.disturbance[i];
    axes += fmt::format("{}{}: x {:.0f}, y {:.0f}, z {:.0f} m/s²", i ? "; " : "",
                        readable_as(line.values[i], line.axis->si_unit, line.axis->unit), a.x(), a.y(), a.z());
  }
  return {"Especially the acceleration changes in the Y direction are more severe.",
          agrees_if(2 * found.strongest_is_y > static_cast<int>(line.size())),
          "Largest departure from the ideal acceleration: " + axes + ".",
          "Which world axis takes the impacts depends on where leg 1 stands and on the leg's dimensions, "
          "which the paper does not give. In our mechanism leg 1 stands in the "
          "x-z plane, and F1's axis, along which the bore cannot push, lies along y at home."};
}

Findings of_clearance(const Mechanism& mechanism, const SweepLine& line) {
  Findings findings;
  const std::vector<double> maximum = over(line, max_error), rms = over(line, rms_error);
  findings.push_back(
      {"When the clearance increases, the displacement curve deviates from the ideal curve; the larger the "
       "clearance, the higher the deviation.",
       agrees_if(rises(maximum) && rises(rms)),
       fmt::format("Maximum: {}. RMS: {}. RMS grows by {} mm per mm of clearance.", listed(line, maximum, "m"),
                   listed(line, rms, "m"), readable_number(slope(line.values, rms))),
       "Most of the time the journal rests on the bore or an end face, so its offset is about the clearance "
       "itself, and the platform moves by that offset times "
       "a factor of order one that the geometry alone sets: error grows in proportion. Penetration adds a "
       "few per cent, impacts the rest of the maximum."});
  findings.push_back(orientation_untouched(mechanism, line, "clearance"));

  const std::vector<double> peak = over(line, peak_acceleration), speed = over(line, fastest_impact);
  findings.push_back(
      {"When the clearance increases, the peak of the platform's linear acceleration increases "
       "significantly.",
       agrees_if(rises(peak, 0.05)),
       fmt::format("Peak of the three axes: {}. Fastest impact: {}.", listed(line, peak, "m/s^2"),
                   listed(line, speed, "m/s")),
       "Across a wider gap the same joint reaction accelerates the journal for longer, so it strikes faster, "
       "and the Hertz force of an impact grows "
       "with speed to the power 1.2. A peak is one impact, so it scatters more than the error does."});

  if (!line.results.front()->boresight.samples.empty()) findings.push_back(strongest_direction(line));
  if (!line.results.front()->boresight.samples.empty())
    findings.push_back(angular_acceleration(mechanism, line,
                                            "The angular acceleration in three directions has a certain degree "
                                            "of sudden change, without an obvious rule in its peak; "
                                            "at 0.4 s the peak is larger with 0.2 mm."));

  const std::vector<double> flight = over(line, free_flight_share);
  findings.push_back(
      {"Reducing the size of the clearance is conducive to enhancing the stability of the movement.",
       agrees_if(rises(peak) && rises(speed)),
       fmt::format("Free flight: {}. Impacts: {}. Peak acceleration and impact speed as above.",
                   listed(line, flight, readable_share), listed(line, over(line, impacts), readable_number)),
       "Taken as gentler impacts and smaller peaks. A smaller gap is crossed sooner and at lower speed; the "
       "number of impacts need not fall with it."});
  return findings;
}

// ---- load

PublishedFinding deviation_grows_with_load(const Mechanism& mechanism, const SweepPlan& plan, const SweepLine& line) {
  const std::vector<double> maximum = over(line, max_error), rms = over(line, rms_error);
  PublishedFinding finding{
      "When the load increases, the displacement curve deviates from the ideal one; the larger the load, the "
      "greater the deviation.",
      agrees_if(rises(maximum) && rises(rms)),
      fmt::format("Maximum: {}. RMS: {}.", listed(line, maximum, "m"), listed(line, rms, "m")), ""};
  finding.why = "The clearance is the same, but the journal is pressed deeper into the bore and the end faces. ";
  if (const auto means = mean_contacts(mechanism, plan, line)) {
    std::vector<double> penetration, hertz, force;
    for (const MeanContact& m : *means) {
      penetration.push_back(m.penetration);
      hertz.push_back(m.hertz);
      force.push_back(m.force);
    }
    finding.measured +=
        fmt::format(" Mean force on the bore: {}. Mean penetration: {}; Hertz gives for the same forces {}.",
                    listed(line, force, "N"), listed(line, penetration, "m"), listed(line, hertz, "m"));
    finding.why += "Penetration follows Hertz, force to the power 2/3. ";
  }
  finding.why += "The rest of the error is the clearance itself, so the error grows by far less than the load.";
  return finding;
}

PublishedFinding directions_under_load(const SweepLine& line) {
  const auto [growth, time_of_z] = growth_per_axis(line);
  return {
      "The X displacement does not change significantly with load, the Y displacement deviates at its peak, "
      "the Z displacement most at 0.25 s.",
      agrees_if(growth.x() < growth.y() && growth.x() < growth.z() && std::abs(time_of_z - 0.25) < 0.1),
      fmt::format("From {} to {} the largest error grows by {} in x, {} in y, {} in z; the largest in z "
                  "stands at {:.2f} s.",
                  readable_as(line.values.front(), line.axis->si_unit, line.axis->unit),
                  readable_as(line.values.back(), line.axis->si_unit, line.axis->unit), readable(growth.x(), "m"),
                  readable(growth.y(), "m"), readable(growth.z(), "m"), time_of_z),
      "Direction and time of the largest error follow from the joint reaction in the legs, hence from "
      "dimensions that the paper does not give."};
}

PublishedFinding peaks_against_load(const SweepLine& line) {
  const std::vector<double> peak = over(line, peak_acceleration), speed = over(line, fastest_impact),
                            force = over(line, largest_force);
  const std::vector<double> flight = over(line, free_flight_share);
  const std::optional<LeastOffTheBore> off = least_off_the_bore(line);
  const bool interior = off && off->interior;
  const bool rising = rises(peak, 0.05), falling = falls(peak, 0.05);
  std::string measured =
      fmt::format("Peak acceleration: {}. Fastest impact: {}. Largest force: {}. Impacts: {}. Free flight: {}. ",
                  listed(line, peak, "m/s^2"), listed(line, speed, "m/s"), listed(line, force, "N"),
                  listed(line, over(line, impacts), readable_number), listed(line, flight, readable_share));
  if (off) measured += fmt::format("Away from the bore: {}. ", listed(line, off->share, readable_share));
  measured += rising    ? "The peak rises with load, as section 4 has it."
              : falling ? "The peak falls with load, as section 5 would have it and against section 4."
                        : "The peak neither rises nor falls throughout: neither sentence holds as it stands.";
  if (off)
    measured += fmt::format(" The journal is away from the bore least at {}, {} of this sweep.",
                            readable_as(line.values[off->point], line.axis->si_unit, line.axis->unit),
                            interior ? "inside the range" : "at an end");
  std::string why =
      "A load adds mass to what an impact has to move, and it adds to the joint reaction that presses the "
      "journal on. ";
  if (falling && (rises(speed) || rises(force)))
    why +=
        "So impacts become faster and harder while the platform shakes less: peak acceleration falls though "
        "the joint suffers more. \"Stability\" holds for the platform, "
        "not for the joint. ";
  else if (rising)
    why += "Here the harder impacts win over the greater mass. ";
  if (interior)
    why += "A moderate load keeps the journal on the bore best: an optimum, not a trend.";
  else if (off && line.size() < 4)
    why += "Two or three loads cannot show an optimum between them; a finer sweep can.";
  return {
      "Section 4: when the load increases, the peak of the linear acceleration increases significantly. "
      "Section 5: increasing the load is conducive to enhancing the stability of the movement.",
      Verdict::explained, std::move(measured), std::move(why)};
}

std::optional<PublishedFinding> intervals_of_impacts(const SweepLine& line) {
  // A "sudden change" is an impact that shows in the curve.
  const std::optional<ImpactIntervals> found = impact_intervals(*line.results.back());
  if (!found) return std::nullopt;
  const auto [n, early, late] = *found;
  return PublishedFinding{
      "At 500 kg the first four sudden changes of the acceleration are about 0.02 s apart, the last four "
      "0.09 s.",
      agrees_if(std::abs(early / 0.02 - 1.0) < 0.5 && std::abs(late / 0.09 - 1.0) < 0.5),
      fmt::format("At {}, among the {} fastest impacts, the first five are {} apart on average, the last five {}.",
                  readable_as(line.values.back(), line.axis->si_unit, line.axis->unit), n, readable(early, "s"),
                  readable(late, "s")),
      "The gap between impacts is the time of flight across the clearance under the joint reaction of that "
      "moment; where the reaction is small, flights are "
      "long. The reaction depends on dimensions and masses that the paper does not give, so its figures "
      "cannot be met, only their kind."};
}

Findings of_load(const Mechanism& mechanism, const SweepPlan& plan, const SweepLine& line) {
  Findings findings = {deviation_grows_with_load(mechanism, plan, line),
                       orientation_untouched(mechanism, line, "load")};
  if (!line.results.front()->boresight.samples.empty()) findings.push_back(directions_under_load(line));
  findings.push_back(peaks_against_load(line));
  if (auto intervals = intervals_of_impacts(line)) findings.push_back(std::move(*intervals));
  if (!line.results.front()->boresight.samples.empty()) {
    PublishedFinding calm =
        angular_acceleration(mechanism, line,
                             "When the load increases, the angular acceleration does not fluctuate like the "
                             "linear one: the load has little influence on the rotation.");
    calm.verdict =
        calm.verdict == Verdict::differs ? Verdict::agrees : Verdict::differs;  // here it is the calm that is claimed
    findings.push_back(std::move(calm));
  }
  return findings;
}

// ---- both

std::optional<PublishedFinding> matching(const SweepPlan& plan, const SweepResult& result, std::size_t clearance,
                                         std::size_t load) {
  std::string text;
  bool interior = false, least_load_is_best = true;
  for (const BestLoads& best : best_loads(plan, result, clearance, load)) {
    interior = interior || best.interior;
    least_load_is_best = least_load_is_best && best.least_load;
    text += fmt::format("{}At {}: smallest error at {}, least free flight at {}.", text.empty() ? "" : " ",
                        readable_as(best.clearance, plan.axes[clearance].si_unit, plan.axes[clearance].unit),
                        readable_as(best.smallest_error, plan.axes[load].si_unit, plan.axes[load].unit),
                        readable_as(best.least_flight, plan.axes[load].si_unit, plan.axes[load].unit));
  }
  if (text.empty()) return std::nullopt;
  return PublishedFinding{
      "Reasonable clearance and load matching is conducive to improving the accuracy of the mechanism.",
      !least_load_is_best ? Verdict::agrees
      : interior          ? Verdict::explained
                          : Verdict::differs,
      text,
      least_load_is_best ? "The error is smallest with the least load at every clearance, so there is "
                           "nothing to match for accuracy; what has an optimum is steadiness, "
                           "the share of time in which the journal does not fly."
                         : "At some clearance the error is smallest with a load above the least one: there "
                           "matching pays in accuracy as well."};
}

}  // namespace

Findings published_findings(const Mechanism& mechanism, const SweepPlan& plan, const SweepResult& result) {
  Findings findings;
  std::optional<std::size_t> clearance, load;
  for (std::size_t i = 0; i < plan.axes.size(); ++i) {
    const SweepLine line = line_along(plan, result, i);
    if (line.size() < 2) continue;
    Findings more;
    if (names_clearance(plan.axes[i])) {
      clearance = i;
      more = of_clearance(mechanism, line);
    } else if (names_load(plan.axes[i])) {
      load = i;
      more = of_load(mechanism, plan, line);
    }
    findings.insert(findings.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  }
  if (clearance && load)
    if (auto match = matching(plan, result, *clearance, *load)) findings.push_back(std::move(*match));
  return findings;
}

}  // namespace boresight::app
