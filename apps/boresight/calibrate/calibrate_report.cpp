#include "calibrate/calibrate_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "calibrate/draws_report.hpp"
#include "report_parts/report_parts.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {
namespace {

nlohmann::json cell(double value) { return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(); }

std::string known_to(double value, const ParameterEstimate& e) {
  return readable_to(value, e.standard_error, e.si_unit, e.written_unit);
}

std::string interval_of(const ParameterEstimate& e) { return known_to(e.low, e) + " to " + known_to(e.high, e); }

std::string names_of(const std::vector<UnexplainedChannel>& channels) {
  std::string names;
  for (std::size_t k = 0; k < channels.size(); ++k)
    names += (k == 0                     ? ""
              : k + 1 == channels.size() ? " or "
                                         : ", ") +
             std::string(channel_names()[static_cast<std::size_t>(channels[k].channel)].name);
  return names;
}

report::Table estimate_table(const CalibrationStudy& s) {
  report::Table table{
      .title = "Estimates",
      .caption = fmt::format("Intervals at {} confidence: where the loss itself has risen by as much (profile), "
                             "else by its curvature.",
                             readable_share(s.plan.confidence)),
      .columns = {
          {"Parameter"}, {"Value"}, {"Standard error"}, {"Of the data alone"}, {"Interval"}, {"By"}, {"Verdict"}}};
  for (std::size_t k = 0; k < s.result.inference.parameters.size(); ++k) {
    const ParameterEstimate& e = s.result.inference.parameters[k];
    const bool profiled = std::any_of(s.result.profiles.begin(), s.result.profiles.end(), [&](const Profile& p) {
      return p.parameter == static_cast<int>(k) && std::isfinite(p.low) && std::isfinite(p.high);
    });
    if (e.identifiable)
      table.rows.push_back(
          {name_of_path(e.name), readable_as(e.value, e.si_unit, e.written_unit),
           readable_as(e.standard_error, e.si_unit, e.written_unit),
           std::isfinite(e.data_error) && !e.by_prior ? readable_as(e.data_error, e.si_unit, e.written_unit) : "",
           interval_of(e), profiled ? "profile" : "curvature", e.reason});
    else
      table.rows.push_back({name_of_path(e.name), "none", "", "", "", "", "not identifiable: " + e.reason});
  }
  return table;
}

report::Table combinations_table(const CalibrationStudy& s) {
  report::Table table{.title = "What is known of errors that cannot be told apart",
                      .caption =
                          "Errors that move the boresight alike wherever it was measured; these combinations of "
                          "them do not change along what the data do not see.",
                      .columns = {{"Combination"}, {"Value"}, {"Standard error"}, {"Interval"}}};
  for (const ConfusedErrors& group : s.result.inference.confused)
    for (const KnownCombination& c : group.known) {
      const std::string written = written_unit_of(c, s.problem);
      table.rows.push_back({in_words(c, s.problem.parameters), readable_as(c.value, c.si_unit, written),
                            readable_as(c.standard_error, c.si_unit, written),
                            readable_as(c.low, c.si_unit, written) + " to " + readable_as(c.high, c.si_unit, written)});
    }
  return table;
}

// What the fit takes as known, and what that may do to each parameter.
report::Table suspects_table(const CalibrationStudy& s) {
  report::Table table{.title = "What the model may be wrong by",
                      .caption =
                          "Each with one standard deviation of what was told, what the data make of it (in these "
                          "deviations), by how much it lowers the loss, and what it adds to the standard error of each "
                          "parameter, in percent of it.",
                      .columns = {{"Suspect"}, {"Found"}, {"Error"}, {"Gain"}}};
  const int count = s.problem.parameter_count();
  for (int p = 0; p < count; ++p) table.columns.push_back({name_of_path(s.problem.parameters[p].path), "%"});
  for (const SuspectFound& found : s.result.model_error->suspects) {
    std::vector<nlohmann::json> row = {found.name, cell(found.mean), cell(found.error), cell(found.gain)};
    for (int p = 0; p < count; ++p) {
      const FittedParameter& parameter = s.problem.parameters[p];
      const double u = s.result.fit.globals.u[p];
      const double size = parameter.is_error() ? parameter.size : parameter.value(u);
      row.push_back(cell(100.0 * found.adds[p] * parameter.slope(u) / size));
    }
    table.rows.push_back(row);
  }
  return table;
}

report::Chart correlation_chart(const CalibrationStudy& s) {
  report::Chart chart{.title = "Correlation of the estimates", .x = {"estimate"}, .y = {"estimate"}};
  report::Heatmap map{.label = "correlation", .diverging = true};
  report::Names names;
  for (const ParameterEstimate& e : s.result.inference.parameters) names.push_back(name_of_path(e.name));
  map.x = map.y = names;
  const MatX& C = s.result.inference.correlation;
  for (Eigen::Index a = 0; a < C.rows(); ++a) {
    report::Numbers row;
    for (Eigen::Index b = 0; b < C.cols(); ++b) row.push_back(C(a, b));
    map.z.push_back(row);
  }
  chart.heatmap = map;
  return chart;
}

report::Panels residual_panels(const CalibrationStudy& s, bool fits) {
  report::Panels panels{
      .title = fits ? "Measured and fitted" : "Residuals over time",
      .caption = fits ? "The first run." : "In standard deviations of each channel's noise; all runs.",
      .columns = 3};
  for (std::size_t c = 0; c < s.problem.channels.size(); ++c) {
    const ChannelName& channel = channel_names()[s.problem.channels[c]];
    double largest = 1e-12;
    for (const ResidualSeries& r : s.result.inference.residuals)
      for (double v : r.measured) largest = std::max(largest, std::abs(v));
    const DisplayUnit unit = display_unit(channel.si_unit, largest);
    report::Chart chart{.title = channel.title,
                        .x = {"Time", "s"},
                        .y = fits ? report::Axis{channel.name, unit.name} : report::Axis{"residual"}};
    report::Series measured{.name = "measured", .y = report::Numbers{}, .style = report::Style::markers},
        fitted{.name = "fitted"};
    report::Numbers t, y, model;
    for (const ResidualSeries& r : s.result.inference.residuals) {
      if (r.channel != static_cast<int>(c) || (fits && r.run != 0)) continue;
      if (fits) {
        for (std::size_t i = 0; i < r.time.size(); ++i) {
          t.push_back(r.time[i]);
          y.push_back(r.measured[i] * unit.per_si);
          model.push_back(r.model[i] * unit.per_si);
        }
      } else {
        t.insert(t.end(), r.time.begin(), r.time.end());
        y.insert(y.end(), r.residual.begin(), r.residual.end());
      }
    }
    if (t.empty()) continue;
    measured.x = t;
    measured.y = y;
    measured.name = fits ? "measured" : "residual";
    chart.series.push_back(measured);
    if (fits) {
      fitted.x = t;
      fitted.y = model;
      chart.series.push_back(fitted);
    }
    panels.panels.push_back(chart);
  }
  return panels;
}

report::Panels residual_checks(const CalibrationStudy& s) {
  report::Panels panels{
      .title = "Are the residuals noise?",
      .caption =
          "Left: residuals against the quantiles of a normal distribution; a straight line is noise, "
          "ends that turn away are outliers. Right: autocorrelation; beyond the lines, neighbours are alike.",
      .columns = 2};
  std::vector<double> all;
  for (const ResidualSeries& r : s.result.inference.residuals)
    all.insert(all.end(), r.residual.begin(), r.residual.end());
  std::sort(all.begin(), all.end());
  report::Chart qq{.title = "Quantiles", .x = {"normal"}, .y = {"residual"}};
  report::Series points{.name = "residuals", .style = report::Style::markers}, line{.name = "noise", .muted = true};
  report::Numbers x, y;
  const boost::math::normal normal;
  const std::size_t every = std::max<std::size_t>(1, all.size() / 400);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i % every != 0 && i > 20 && i + 20 < all.size()) continue;
    x.push_back(boost::math::quantile(normal, (static_cast<double>(i) + 0.5) / static_cast<double>(all.size())));
    y.push_back(all[i]);
  }
  points.x = x;
  points.y = y;
  line.x = report::Numbers{-4.0, 4.0};
  line.y = report::Numbers{-4.0, 4.0};
  qq.series = {points, line};
  const double bound = 2.0 / std::sqrt(static_cast<double>(std::max(1L, s.result.inference.values)));
  report::Chart lags{.title = "Autocorrelation",
                     .x = {"lag", "samples"},
                     .y = {"correlation"},
                     .lines = {{'y', bound, ""}, {'y', -bound, ""}}};
  report::Series bars{.name = "autocorrelation", .style = report::Style::bars};
  report::Numbers lag, value;
  for (std::size_t l = 1; l < s.result.inference.autocorrelations.size(); ++l) {
    lag.push_back(static_cast<double>(l));
    value.push_back(s.result.inference.autocorrelations[l]);
  }
  bars.x = lag;
  bars.y = value;
  lags.series = {bars};
  panels.panels = {qq, lags};
  return panels;
}

report::Panels profile_panels(const CalibrationStudy& s) {
  report::Panels panels{.title = "Profile likelihood",
                        .caption =
                            "How much worse the fit becomes when one parameter is held and all others are "
                            "fitted anew: the root of the "
                            "rise of the loss, straight where the loss is a parabola. "
                            "The line: where the interval ends.",
                        .columns = 2};
  const double rise = boost::math::quantile(boost::math::chi_squared(1.0), s.plan.confidence);
  for (const Profile& p : s.result.profiles) {
    const double estimate = s.result.inference.parameters[p.parameter].value;
    report::Chart chart{.title = name_of_path(s.problem.parameters[p.parameter].path),
                        .x = {"change of the value", "%"},
                        .y = {"root of the rise"},
                        .lines = {{'y', std::sqrt(rise), readable_share(s.plan.confidence)}}};
    report::Series line{.name = "rise", .style = report::Style::line_markers};
    report::Numbers change;
    for (double v : p.value) change.push_back(100.0 * (v / estimate - 1.0));
    line.x = change;
    report::Numbers root;
    for (double v : p.cost_rise) root.push_back(std::sqrt(v));
    line.y = root;
    chart.series = {line};
    panels.panels.push_back(chart);
  }
  return panels;
}

report::Table starts_table(const CalibrationStudy& s) {
  report::Table table{.title = "Starts",
                      .caption = "Tried on the first part of every run: where from, where to. The cheapest went on.",
                      .columns = {{"Start"}}};
  for (const FittedParameter& p : s.problem.parameters) table.columns.push_back({name_of_path(p.path)});
  table.columns.push_back({"Cost"});
  for (std::size_t k = 0; k < s.result.starts.size(); ++k) {
    const StartFound& start = s.result.starts[k];
    std::vector<nlohmann::json> row = {static_cast<double>(k + 1)};
    for (std::size_t p = 0; p < start.from.size(); ++p) {
      const std::string& unit = s.problem.parameters[p].si_unit;
      const std::string& written = s.problem.parameters[p].written_unit;
      row.push_back(readable_as(start.from[p], unit, written) + " to " + readable_as(start.to[p], unit, written));
    }
    row.push_back(cell(start.cost));
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace

DisplayUnit unit_of_estimate(const ParameterEstimate& e) {
  return display_unit_as(e.si_unit, std::abs(e.value), e.written_unit);
}

std::string written_unit_of(const KnownCombination& c, const CalibrationProblem& problem) {
  return problem.parameters[static_cast<std::size_t>(c.terms.front().first)].written_unit;
}

report::Document calibrate_report(const CalibrationStudy& s) {
  const Inference& inference = s.result.inference;
  report::Document document{
      .title = s.mechanism.name(),
      .subtitle = !s.problem.fits_errors()   ? "calibration of its contacts by measured pointing data"
                  : s.problem.follows_play() ? "calibration of its contacts and standing errors by measured "
                                               "pointing data"
                                             : "calibration of its standing errors by measured pointing data",
      .verb = "calibrate"};
  document.warnings = s.result.warnings;
  const bool all = std::all_of(inference.parameters.begin(), inference.parameters.end(),
                               [](const auto& e) { return e.identifiable; });
  const auto assumed = std::count_if(inference.parameters.begin(), inference.parameters.end(),
                                     [](const ParameterEstimate& e) { return e.by_prior; });
  document.verdict = report::Verdict{
      all && s.result.fit.converged && s.result.unexplained.empty() ? report::Standing::good : report::Standing::bad,
      !s.result.unexplained.empty() ? "The model does not explain what " + names_of(s.result.unexplained) + " reads."
      : all && s.result.fit.converged && assumed == 0 ? std::string("All parameters are identifiable from these data.")
      : all && s.result.fit.converged
          ? fmt::format("These data tell {} of {} parameters; the rest stands as was assumed before.",
                        inference.parameters.size() - static_cast<std::size_t>(assumed), inference.parameters.size())
      : s.result.verdict.empty() ? s.result.fit.reason
                                 : s.result.verdict.front()};
  for (const ParameterEstimate& e : inference.parameters)
    if (e.name.starts_with("clearance.") || e.name.starts_with("error."))
      document.facts.push_back({name_of_path(e.name),
                                e.identifiable ? known_to(e.value, e) : std::string("not identifiable"), "",
                                e.identifiable ? interval_of(e) : e.reason});
  report::Section answer{.id = "answer", .title = "What the data say"};
  std::string words;
  for (const std::string& sentence : s.result.verdict) words += (words.empty() ? "" : "\n\n") + sentence;
  words += fmt::format(
      "\n\nThe fit {}; {} evaluations of windows. {} values, {} unknowns; the noise is "
      "{:.3g} times "
      "what was taken for it.",
      s.result.fit.reason, s.result.evaluations, inference.values, inference.unknowns,
      std::sqrt(inference.variance_factor));
  if (s.result.confirmation >= 0.0)
    words += fmt::format(
        "\n\nConfirmed on multibody: its motion at the optimum leaves residuals of {:.3g} standard "
        "deviations (rms).",
        s.result.confirmation);
  if (s.result.hold_out)
    words += fmt::format(
        "\n\nOn {} values kept out of the fit, residuals are {:.3g} standard deviations (rms); 1 is as good "
        "as the noise allows.",
        s.result.hold_out->values, s.result.hold_out->rms);
  answer.items = {report::Text{words}, estimate_table(s)};
  if (report::Table known = combinations_table(s); !known.rows.empty()) answer.items.push_back(std::move(known));
  answer.items.push_back(correlation_chart(s));
  report::Section residuals{.id = "residuals", .title = "Residuals"};
  residuals.items = {residual_panels(s, true), residual_panels(s, false), residual_checks(s)};
  document.sections = {answer, residuals};
  if (s.result.draws) document.sections.push_back(draws_section(*s.result.draws, s.plan.confidence));
  report::Section more{.id = "more", .title = "How sure, and what next"};
  if (s.result.model_error && !s.result.model_error->suspects.empty()) more.items.push_back(suspects_table(s));
  if (!s.result.profiles.empty()) more.items.push_back(profile_panels(s));
  if (!s.result.laws.empty()) {
    report::Table laws{
        .title = "Contact laws by the same data",
        .caption = fmt::format("AIC: lower is better; a difference above 10 decides. Residuals that follow one another "
                               "count as {:.4g} independent ones.",
                               s.result.laws.front().effective_values),
        .columns = {{"Law"}, {"Parameters"}, {"AIC"}, {"Difference"}, {"Held-out rms"}}};
    for (const LawScore& l : s.result.laws)
      laws.rows.push_back(
          {l.law, l.parameters, cell(l.aic), cell(l.difference), l.held_out ? cell(*l.held_out) : nlohmann::json()});
    more.items.push_back(laws);
  }
  if (!s.result.next_tests.empty()) {
    report::Table next{
        .title = "The next test",
        .caption =
            "What one more run of each candidate would do to the intervals. D: gain in the logarithm of the "
            "information's determinant; A: sum of relative variances, with it over without it.",
        .columns = {{"Candidate"}, {"D gain"}, {"A ratio"}, {"Standard errors become"}}};
    for (const NextTest& t : s.result.next_tests) {
      std::string errors = t.refusal;
      for (double r : t.error_ratio) errors += fmt::format("{}{:.0f} %", errors.empty() ? "" : ", ", 100.0 * r);
      next.rows.push_back({t.name, cell(t.d_gain), cell(t.a_ratio), errors});
    }
    more.items.push_back(next);
  }
  if (!s.result.starts.empty()) more.items.push_back(starts_table(s));
  if (!s.result.corrections.empty()) {
    report::Table steps{
        .title = "Corrections by multibody",
        .caption =
            "Multibody less perturbation at the optimum (rms) enters the model, from the second step on with "
            "multibody's own slopes; then the fit goes on.",
        .columns = {{"Step"}, {"Difference", "deviations"}, {"Largest shift of a parameter", "%"}}};
    for (std::size_t k = 0; k < s.result.corrections.size(); ++k)
      steps.rows.push_back({static_cast<double>(k + 1), cell(s.result.corrections[k].difference),
                            cell(100.0 * s.result.corrections[k].largest_shift)});
    more.items.push_back(steps);
  }
  if (!more.items.empty()) document.sections.push_back(more);
  document.provenance = provenance_of(s.command, s.mechanism, s.rung);
  return document;
}

}  // namespace boresight::app
