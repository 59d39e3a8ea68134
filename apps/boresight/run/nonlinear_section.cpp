#include "run/nonlinear_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "boresight/mechanism/error.hpp"
#include "report_parts/report_parts.hpp"
#include "results/tables.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {
namespace {

std::vector<double> row(const MatX& states, int which, double per_si, Eigen::Index from = 0) {
  std::vector<double> values;
  for (Eigen::Index k = from; k < states.cols(); ++k) values.push_back(per_si * states(which, k));
  return values;
}

std::string sentence(const JointDynamics& j) {
  const std::string comes_back = j.period == 1  ? "comes back every period of the drive"
                                 : j.period > 1 ? fmt::format("comes back every {} periods of the drive", j.period)
                                                : "does not come back to itself";
  if (j.divergence.pairs == 0) return j.joint + " " + comes_back + "; too few periods to say how neighbours part.";
  const Divergence& d = j.divergence;
  if (!d.rises) return fmt::format("{} {}; neighbouring states do not part.", j.joint, comes_back);
  return fmt::format(
      "{} {}; neighbouring states part e-fold every {} (largest Lyapunov exponent {:.3g} ± {:.1g} 1/s, {} "
      "pairs).",
      j.joint, comes_back, readable(1.0 / d.exponent, "s"), d.exponent, d.standard_error, d.pairs);
}

}  // namespace

double spacing_on_period(double asked, double period) { return period / std::ceil(period / asked - 1e-9); }

void check_period(const Mechanism& mechanism, double period) {
  const Origin command_line{"command line", 0};
  if (mechanism.clearances() == 0)
    throw InputError(command_line, "--nonlinear", "a mechanism without clearance", "one with clearance");
  bool pads = true;
  for (int c = 0; c < mechanism.clearances(); ++c) pads = pads && is_pad(mechanism, c);
  if (pads)
    throw InputError(command_line, "--nonlinear", "pads alone, which slide where the mechanism has them",
                     "a journal or a ball with clearance");
  if (mechanism.duration() < 10.0 * period)
    throw InputError(command_line, "--nonlinear",
                     fmt::format("{:.3g} periods in the motion", mechanism.duration() / period),
                     "ten or more; lengthen motion.duration");
}

NonlinearAnalysis analyse_nonlinear(const Mechanism& mechanism, const RunResult& result, double period) {
  NonlinearAnalysis analysis;
  analysis.period = period;
  if (result.time.size() < 3) return analysis;
  const double spacing = result.time[1] - result.time[0];
  for (std::size_t k = 0; k < result.time.size(); ++k)
    if (std::abs(result.time[k] - static_cast<double>(k) * spacing) > 0.01 * spacing)
      throw ComputationError(
          "--nonlinear: the samples are not evenly spaced, and neighbouring states would be sought at different phases "
          "of "
          "the drive; leave out --step, or give one that divides --sample");
  const int per_period = static_cast<int>(std::lround(period / spacing));
  analysis.periods = static_cast<int>((result.time.size() - 1) / static_cast<std::size_t>(per_period));
  analysis.skipped = analysis.periods / 5;
  const Eigen::Index first = static_cast<Eigen::Index>(analysis.skipped) * per_period;
  const Eigen::Index samples = static_cast<Eigen::Index>(analysis.periods) * per_period + 1 - first;
  for (int c = 0; c < mechanism.clearances(); ++c) {
    if (is_pad(mechanism, c)) continue;  // what is across its normal is the mechanism's own motion
    JointDynamics joint;
    joint.clearance = c;
    joint.joint = joint_of_clearance(mechanism, c);
    joint.series = {spacing, per_period, MatX(4, samples)};
    for (Eigen::Index k = 0; k < samples; ++k) {
      const ClearanceSample& s = result.clearances[c][static_cast<std::size_t>(first + k)];
      joint.series.states.col(k) << s.offset.x(), s.offset.z(), s.offset_rate.x(), s.offset_rate.z();
    }
    joint.section = poincare_section(joint.series, 0);
    const VecX size = joint.series.states.rowwise().maxCoeff() - joint.series.states.rowwise().minCoeff();
    joint.period = section_period(joint.section, size);
    joint.divergence = largest_lyapunov_exponent(joint.series, 0.99 * period,
                                                 std::min(5.0, 0.25 * (analysis.periods - analysis.skipped)) * period);
    analysis.joints.push_back(std::move(joint));
  }
  return analysis;
}

report::Section nonlinear_section(const NonlinearAnalysis& analysis, const Mechanism& mechanism) {
  report::Section section{
      .id = "nonlinear",
      .title = "Nonlinear motion",
      .intro = fmt::format("Seen once every {}, the drive's period; {} periods, of which the first {} are left out.",
                           readable(analysis.period, "s"), analysis.periods, analysis.skipped)};
  for (const JointDynamics& j : analysis.joints) {
    section.items.push_back(report::Text{sentence(j)});
    const ClearanceParameters& gap = mechanism.parameters().clearance[static_cast<std::size_t>(j.clearance)];
    const double radial = 1e6 * gap.*carrying_gap(gap);
    const bool slider = is_slider(mechanism, j.clearance);
    report::Panels panels{
        .title = j.joint + (slider ? ": the slider's centre in its guide" : ": the journal's centre in its sleeve"),
        .caption =
            "Above the section: one point a period. One point: the drive's own period; a few: a multiple of "
            "it; a closed curve: two periods that do not fit; a cloud: chaos, or periods too few to tell.",
        .columns = 2,
        .shared_legend = false};
    const auto markers = [&](const char* title, int x, int y, const char* x_label, const char* y_label,
                             const char* y_unit, double y_per_si) {
      report::Chart chart{.title = title, .caption = {}, .x = {x_label, "µm"}, .y = {y_label, y_unit}};
      chart.series.push_back({.name = "once a period",
                              .x = row(j.section, x, 1e6),
                              .y = row(j.section, y, y_per_si),
                              .style = report::Style::markers});
      return chart;
    };
    report::Chart place = markers("Poincaré section: place", 0, 1, "x", "z", "µm", 1e6);
    place.equal_axes = true;
    if (slider) {
      const double w = 1e6 * gap.width_gap, h = 1e6 * gap.height_gap;
      place.series.push_back({.name = "room in the guide",
                              .x = report::Numbers{-w, w, w, -w, -w},
                              .y = report::Numbers{-h, -h, h, h, -h}});
    } else {
      place.circles.push_back({0.0, 0.0, radial, "bore"});
    }
    panels.panels.push_back(std::move(place));
    panels.panels.push_back(markers("Poincaré section: state along x", 0, 2, "x", "rate of x", "mm/s", 1e3));
    // The newest ten periods, so that single orbits can be told apart.
    const Eigen::Index from = std::max<Eigen::Index>(0, j.series.states.cols() - 1 - 10 * j.series.per_period);
    for (const auto& [title, x, label] :
         {std::tuple{"Phase portrait along x", 0, "x"}, std::tuple{"Phase portrait along z", 1, "z"}}) {
      report::Chart portrait{
          .title = title, .caption = {}, .x = {label, "µm"}, .y = {std::string("rate of ") + label, "mm/s"}};
      portrait.series.push_back({.name = "last ten periods",
                                 .x = row(j.series.states, x, 1e6, from),
                                 .y = row(j.series.states, x + 2, 1e3, from)});
      panels.panels.push_back(std::move(portrait));
    }
    section.items.push_back(std::move(panels));
    if (j.divergence.t.empty()) continue;
    report::Chart parting{
        .title = j.joint + ": how neighbouring states part",
        .caption =
            "Mean logarithm of the distance between each state and its nearest neighbour at the same phase "
            "of "
            "the drive, states scaled by their spread (Rosenstein, Collins, De Luca 1993). The slope of "
            "the rise is the largest Lyapunov exponent.",
        .x = {"Time", "ms"},
        .y = {"mean ln distance", ""}};
    std::vector<double> t;
    for (const double s : j.divergence.t) t.push_back(1e3 * s);
    parting.series.push_back({.name = "mean over all pairs", .x = t, .y = j.divergence.log_distance});
    if (j.divergence.rises) {
      parting.lines.push_back({'x', 1e3 * j.divergence.fitted_from, "fitted from"});
      parting.lines.push_back({'x', 1e3 * j.divergence.fitted_until, "fitted until"});
    }
    section.items.push_back(std::move(parting));
  }
  return section;
}

Json nonlinear_json(const NonlinearAnalysis& analysis) {
  Json json = {{"period", analysis.period}, {"periods", analysis.periods}, {"skipped", analysis.skipped}};
  for (const JointDynamics& j : analysis.joints)
    json["joints"][j.joint] = {{"section_points", j.section.cols()},
                               {"period", j.period == 0 ? Json() : Json(j.period)},
                               {"lyapunov",
                                {{"value", j.divergence.pairs > 0 ? Json(j.divergence.exponent) : Json()},
                                 {"standard_error", j.divergence.standard_error},
                                 {"rises", j.divergence.rises},
                                 {"fitted_until", j.divergence.fitted_until},
                                 {"pairs", j.divergence.pairs}}}};
  return json;
}

void write_section(std::ostream& out, const NonlinearAnalysis& analysis) {
  out << "joint,t,x,z,vx,vz\n";
  for (const JointDynamics& j : analysis.joints)
    for (Eigen::Index k = 0; k < j.section.cols(); ++k) {
      out << csv_field(j.joint) << ',' << exact((analysis.skipped + static_cast<double>(k)) * analysis.period);
      for (int i = 0; i < 4; ++i) out << ',' << exact(j.section(i, k));
      out << '\n';
    }
}

}  // namespace boresight::app
