// Contributors with a spectrum: their densities, the windows' filters, and both computations of what the indices keep of them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "boresight_analyses/budget/between_samples.hpp"
#include "boresight_analyses/budget/budget_runs.hpp"
#include "boresight_analyses/budget/window_filter.hpp"
#include "budget/budget_parts.hpp"
#include "report_parts/report_parts.hpp"
#include "results/scatter_parts.hpp"
#include "results/tables.hpp"

namespace boresight::app {
namespace {

constexpr std::size_t kPoints = 300;  // of a curve

// Evenly in the logarithm.
std::vector<double> between(double from, double to) {
  std::vector<double> out;
  for (std::size_t k = 0; k < kPoints; ++k)
    out.push_back(from * std::pow(to / from, static_cast<double>(k) / static_cast<double>(kPoints - 1)));
  return out;
}

// What a history can tell of: from one over its length to half the sampling's frequency.
std::array<double, 2> told(const BudgetPlan& plan) { return {1.0 / plan.duration, 0.5 / plan.sampling}; }

// The axes of a contributor together, its factor's mean square included [unit^2/Hz].
struct Density {
  std::string name;
  std::vector<double> frequency, density;
};

std::vector<Density> densities(const BudgetPlan& plan) {
  const auto [least, most] = told(plan);
  std::vector<Density> out;
  for (const Contributor& c : plan.contributors) {
    if (!c.noise) continue;
    double factor = 0.0;
    for (std::size_t a = 0; a < 3; ++a)
      if (const DistributionPtr& d = c.parameter[a])
        factor += (d->mean() * d->mean() + d->sd() * d->sd()) * c.frame.col(static_cast<Eigen::Index>(a)).squaredNorm();
    Density one{c.name, {}, {}};
    for (const double f : between(std::max(least, c.noise->least()), std::min(most, c.noise->most()))) {
      one.frequency.push_back(f);
      one.density.push_back(factor * c.noise->at(f));
    }
    out.push_back(std::move(one));
  }
  return out;
}

report::Chart density_chart(const BudgetStudy& s, const Budget& b) {
  const DisplayUnit unit = budget_unit(s, headline_level(b).level.value);
  report::Chart chart{
      .title = "Power spectral densities",
      .caption = fmt::format(
          "One-sided, all axes together: their integral over frequency is the mean square. Lines: contributors, behind "
          "their transfer "
          "functions. Points: the whole error of the first {} members, less each one's mean, by periodograms.",
          b.shown.size()),
      .x = {"frequency", "Hz", true},
      .y = {"density", unit.name + "²/Hz", true}};
  const double scale = unit.per_si * unit.per_si;
  double largest = 0.0;
  for (const double d : b.spectrum.density) largest = std::max(largest, d);
  for (const Density& d : densities(s.plan)) {
    report::Numbers y;
    for (const double value : d.density) y.push_back(value > 0.0 ? value * scale : std::nan(""));
    for (const double value : d.density) largest = std::max(largest, value);
    chart.series.push_back({.name = d.name, .x = d.frequency, .y = y});
  }
  report::Numbers seen;
  for (const double value : b.spectrum.density) seen.push_back(value > 0.0 ? value * scale : std::nan(""));
  chart.series.push_back(
      {.name = "simulated, everything", .x = b.spectrum.frequency, .y = seen, .style = report::Style::markers});
  constexpr double kDecadesShown = 1e-10;
  chart.y.range = {largest * scale * kDecadesShown, largest * scale * 10.0};
  double least = largest;
  for (const double value : b.spectrum.density)
    if (value > 0.0) least = std::min(least, value);
  if (least > largest * kDecadesShown) chart.y.range = {0.3 * least * scale, 3.0 * largest * scale};
  return chart;
}

report::Chart filter_chart(const BudgetStudy& s) {
  report::Chart chart{
      .title = "What the windows keep",
      .caption =
          "Share |F|² of a sinusoid's mean square by its frequency (ESSB-HB-E-003, 8; exact). Above 1 where two "
          "windows' means add up.",
      .x = {"frequency", "Hz", true},
      .y = {"share kept"}};
  const auto [least, most] = told(s.plan);
  const std::vector<double> frequency = between(0.1 * least, most);
  for (const ErrorIndex index : s.plan.indices()) {
    report::Numbers y;
    for (const double f : frequency) y.push_back(kept_of_sinusoid(index, 2.0 * M_PI * f, s.plan.windows));
    chart.series.push_back({.name = to_string(index), .x = frequency, .y = y});
  }
  return chart;
}

report::Table spectral_table(const BudgetStudy& s, const Budget& b) {
  double largest = 0.0;
  for (const SpectralLevel& l : b.spectral) largest = std::max({largest, l.by_filter, l.simulated});
  const DisplayUnit unit = budget_unit(s, largest);
  report::Table table{
      .title = "Root mean squares in " + unit.name + ", by the windows' filters and simulated",
      .caption = fmt::format("Of one axis, over members and time. By filter: the integral of |F|² over the "
                             "contributor's spectrum. From and to: interval of what "
                             "was simulated. They differ where the filter's value lies outside of it and is more than "
                             "{:.0f} % off; where nothing differs, the "
                             "probability of any such flag in this table is {:.0f} %. Sources: {}, simulated {}.",
                             100.0 * kTolerable, 100.0 * kFalseFlags, kFromClasses, kFromMembers),
      .columns = {{"Contributor"},
                  {"Index"},
                  {"By filter"},
                  {"Simulated"},
                  {"from"},
                  {"to"},
                  {"The two"},
                  {"Above half the sampling's frequency", "%"}}};
  for (const SpectralLevel& l : b.spectral)
    table.rows.push_back({l.contributor, to_string(l.index), l.by_filter * unit.per_si, l.simulated * unit.per_si,
                          l.low * unit.per_si,
                          std::isfinite(l.high) ? nlohmann::json(l.high * unit.per_si) : nlohmann::json(),
                          l.differs ? "differ" : "agree", 100.0 * l.above_sampling});
  return table;
}

}  // namespace

report::Section spectra_section(const BudgetStudy& s, const Budget& b) {
  const auto differing =
      std::count_if(b.spectral.begin(), b.spectral.end(), [](const SpectralLevel& l) { return l.differs; });
  return {
      .id = "spectra",
      .title = "Spectra",
      .intro = fmt::format(
          "What the windows keep of {} contributor{} with a spectrum is known twice: in the frequency domain, and from "
          "simulated courses. {} of {} values differ.",
          densities(s.plan).size(), densities(s.plan).size() == 1 ? "" : "s", differing, b.spectral.size()),
      .items = {density_chart(s, b), filter_chart(s), spectral_table(s, b)}};
}

void write_spectra(std::ostream& out, const BudgetStudy& s, const Budget& b) {
  out << "of,frequency,density\n";
  const auto rows = [&](const std::string& name, const std::vector<double>& frequency,
                        const std::vector<double>& density) {
    for (std::size_t k = 0; k < frequency.size(); ++k)
      out << csv_field(name) << ',' << exact(frequency[k]) << ',' << exact(density[k]) << '\n';
  };
  for (const Density& d : densities(s.plan)) rows(d.name, d.frequency, d.density);
  rows("", b.spectrum.frequency, b.spectrum.density);
}

Json spectra_json(const Budget& b) {
  Json json = Json::array();
  for (const SpectralLevel& l : b.spectral)
    json.push_back({{"contributor", l.contributor},
                    {"index", to_string(l.index)},
                    {"by_filter", l.by_filter},
                    {"simulated", l.simulated},
                    {"low", l.low},
                    {"high", number_json(l.high)},
                    {"differs", l.differs},
                    {"above_sampling", l.above_sampling}});
  return json;
}

std::vector<std::string> courses_warnings(const BudgetStudy& s) {
  constexpr double kMuchBetween = 0.02;  // eight samples a period have 0.006, four 0.1
  std::vector<std::string> out;
  // What drifts within a window is whole however few its samples are; of what bends they miss about 1/N^2.
  constexpr double kFewInWindow = 10.0;
  double least = kFewInWindow;
  for (const BudgetRequirement& r : s.plan.requirements)
    if (r.index == ErrorIndex::rpe) least = std::min(least, std::round(s.plan.windows_of(r).window / s.plan.sampling));
  if (least < kFewInWindow)
    out.push_back(
        fmt::format("RPE is asked for over {:.0f} samples of the histories: what changes within a window but steadily "
                    "is seen coarsely; a finer `sampling` shows it",
                    least));
  for (const Contributor& c : s.plan.contributors) {
    if (c.kind == ContributorClass::random && !c.noise && c.correlation_time < s.plan.sampling)
      out.push_back(
          fmt::format("the correlation time of {}, {}, is shorter than the histories' `sampling`, {}: means of "
                      "it over windows come out too large",
                      c.name, readable(c.correlation_time, "s"), readable(s.plan.sampling, "s")));
    double share = 0.0;
    if (c.measured) share = c.measured->share_between_samples();
    if (c.of_error && c.of_error->course)
      share = share_between_samples(
          [&](double t) {
            return std::array<double, 3>{c.of_error->course->at(t).value, 0.0, 0.0};
          },
          s.plan.start, s.plan.sampling, samples_of(s.plan));
    if (share > kMuchBetween)
      out.push_back(fmt::format(
          "{} changes faster than the histories are sampled: between samples it departs from a straight line by {} of "
          "its own deviation, so that they have it slower than it is, or not at all; a finer `sampling` holds it",
          c.name, readable_share(std::min(1.0, std::sqrt(share)))));
  }
  return out;
}

std::vector<std::string> spectra_warnings(const BudgetStudy& s, const Budget& b) {
  std::vector<std::string> out;
  std::string last;
  for (const SpectralLevel& l : b.spectral) {
    constexpr double kMuchAbove = 0.01;
    if (l.above_sampling > kMuchAbove && l.contributor != last)
      out.push_back(
          fmt::format("{} of the power of {} lies above half the sampling's frequency, and is folded down in the "
                      "simulated histories; a finer `sampling` holds it",
                      readable_share(l.above_sampling), l.contributor));
    last = l.contributor;
    if (l.differs)
      out.push_back(fmt::format("{}, {}: {} by the window's filter, {} simulated ({} to {}); they differ",
                                l.contributor, to_string(l.index), budget_value(s, l.by_filter),
                                budget_value(s, l.simulated), budget_value(s, l.low), budget_value(s, l.high)));
  }
  return out;
}

}  // namespace boresight::app
