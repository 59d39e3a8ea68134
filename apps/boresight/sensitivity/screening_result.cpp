// Elementary effects as the sensitivity verb tells them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ostream>

#include "report_parts/report_parts.hpp"
#include "results/scatter_parts.hpp"
#include "results/tables.hpp"
#include "sensitivity/leading_groups.hpp"
#include "sensitivity/method_result.hpp"
#include "terminal/columns.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

class ScreeningResult final : public MethodResult {
 public:
  ScreeningResult(const Study& study, const SensitivityPlan& plan, Screening screening)
      : study_(study), plan_(plan), screening_(std::move(screening)), order_(screening_.groups.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      return screening_.groups[a].mu_star.value > screening_.groups[b].mu_star.value;
    });
  }

  RowCounts counts() const override { return screening_; }
  std::string sentence() const override {
    if (!screening_.varies) return "The index does not depend on what scatters.";
    if (!(screening_.largest() > 0.0))
      return fmt::format(
          "No move between {} levels changes the index, and yet it is not the same everywhere: more levels, or "
          "method = \"sobol\", show what changes it",
          plan_.trajectories->levels());
    std::vector<MeasuredGroup> effects;
    for (const ScreenedGroup& g : screening_.groups) effects.push_back({g.name, g.mu_star});
    const std::vector<MeasuredGroup> leading = leading_groups(effects);
    const std::string mu_stars = measures_of(leading, [&](double si) { return value(si); });
    return fmt::format("{}{}; {} of {} parameters or groups {} negligible",
                       names_of(leading) + (leading.size() > 1 ? " move the index most; these samples do not tell them "
                                                                 "apart: their mu* are "
                                                               : " moves the index most: mu* is "),
                       mu_stars, screening_.negligible(), screening_.groups.size(),
                       screening_.negligible() == 1 ? "is" : "are");
  }
  std::vector<report::Fact> facts() const override {
    return {{"largest mu*", value(screening_.largest()), "", "change of the index over a parameter's whole range"},
            {"negligible", static_cast<double>(screening_.negligible()), "",
             fmt::format("of {}: mu* with its interval below {:g} % of the largest", screening_.groups.size(),
                         100.0 * plan_.negligible)}};
  }
  report::Section section() const override {
    const DisplayUnit unit = display_unit(study_.index.si_unit(), screening_.largest());
    report::Section section{
        .id = "screening",
        .title = "What moves the index",
        .intro = fmt::format(
            "The index is the {}. Along {} trajectories one parameter after the other moves by half of its "
            "distribution, between {} levels of equal probability. An elementary effect is the change of the index, "
            "twice as large: as if the parameter had gone through its whole range of probabilities. mu* is the mean "
            "size of "
            "these changes, sigma their standard deviation.",
            study_.index.title(), screening_.rows, plan_.trajectories->levels())};
    section.items.push_back(bars(unit));
    section.items.push_back(against_sigma(unit));
    section.items.push_back(table());
    return section;
  }
  std::vector<std::string> warnings() const override { return {}; }
  void add_to(Json& json) const override {
    for (std::size_t g = 0; g < screening_.groups.size(); ++g) {
      const ScreenedGroup& group = screening_.groups[g];
      Json& entry = json["morris"][group.name];
      entry = {{"parameters", parameters_of(plan_, g)}, {"mu_star", interval_json(group.mu_star)}};
      entry["mu"] = group.mu ? interval_json(*group.mu) : Json();
      entry["sigma"] = group.sigma ? interval_json(*group.sigma) : Json();
      entry["negligible"] = group.negligible;
    }
    json["negligible_below"] = plan_.negligible * screening_.largest();
    json["basis"] = screening_.groups.front().mu_star.basis;
  }
  std::string table_name() const override { return "morris.csv"; }
  void write_table(std::ostream& out) const override {
    out << "group,mu_star,mu_star_low,mu_star_high,mu,mu_low,mu_high,sigma,sigma_low,sigma_high,negligible\n";
    for (const ScreenedGroup& g : screening_.groups) {
      out << csv_field(g.name);
      const auto write = [&](const ReportedInterval* i) {
        if (i == nullptr)
          out << ",,,";
        else
          out << ',' << exact(i->value) << ',' << exact(i->low) << ',' << exact(i->high);
      };
      write(&g.mu_star);
      write(g.mu ? &*g.mu : nullptr);
      write(g.sigma ? &*g.sigma : nullptr);
      out << ',' << (g.negligible ? "true" : "false") << '\n';
    }
  }
  void print(const std::string& rung) const override {
    tell("  index: {}; elementary effects over {} trajectories; {} rung\n", study_.index.title(), screening_.rows,
         rung);
    const std::size_t widest = widest_of(screening_.groups, [](const ScreenedGroup& g) { return g.name; });
    for (const std::size_t k : order_) {
      const ScreenedGroup& g = screening_.groups[k];
      tell("  {}  mu* {:>10} ({} to {})   {}{}\n", padded(g.name, widest), value(g.mu_star.value), value(g.mu_star.low),
           value(g.mu_star.high), g.sigma ? "sigma " + value(g.sigma->value) : "", g.negligible ? "   negligible" : "");
    }
    if (screening_.negligible() > 0 && screening_.negligible() < screening_.groups.size())
      tell(
          "  negligible: {} of {}, with mu* below {:g} % of the largest; dividing the variance (method = \"sobol\") "
          "may leave {} out\n",
          screening_.negligible(), screening_.groups.size(), 100.0 * plan_.negligible,
          screening_.negligible() == 1 ? "it" : "them");
  }

 private:
  std::string value(double si) const { return readable(si, study_.index.si_unit()); }

  report::Chart bars(const DisplayUnit& unit) const {
    report::Chart chart{
        .title = "mu*: how far the index moves",
        .caption = fmt::format("Whiskers: {:g} % intervals. What lies wholly below the line is negligible.",
                               100.0 * plan_.confidence),
        .x = {"mu*", unit.name},
        .y = {"parameter or group", ""},
        .height = report::height_of_bars(order_.size(), 26)};
    report::Series series{.name = "mu*", .style = report::Style::bars};
    report::Names names;
    report::Numbers sizes;
    for (const std::size_t k : order_) {
      const ScreenedGroup& g = screening_.groups[k];
      names.push_back(g.name);
      sizes.push_back(g.mu_star.value * unit.per_si);
      series.error_low.push_back((g.mu_star.value - g.mu_star.low) * unit.per_si);
      series.error_high.push_back((g.mu_star.high - g.mu_star.value) * unit.per_si);
    }
    series.x = sizes;
    series.y = names;
    chart.series = {series};
    chart.lines = {{'x', plan_.negligible * screening_.largest() * unit.per_si, "negligible"}};
    return chart;
  }

  report::Chart against_sigma(const DisplayUnit& unit) const {
    report::Chart chart{
        .title = "sigma against mu*",
        .caption =
            "Far to the right: matters. Far up: how much it does depends on where it and the others are, so it acts "
            "along a bent line or together with others. Near the level axis: acts along a straight line. Groups of "
            "several parameters are left out, as each member moves to its own side.",
        .x = {"mu*", unit.name},
        .y = {"sigma", unit.name},
        .height = 420};
    report::Series points{.name = "parameters", .style = report::Style::markers};
    report::Numbers x, y;
    double most = 0.0;
    for (const std::size_t k : order_) {
      const ScreenedGroup& g = screening_.groups[k];
      if (!g.sigma) continue;
      x.push_back(g.mu_star.value * unit.per_si);
      y.push_back(g.sigma->value * unit.per_si);
      points.text.push_back(g.name);
      most = std::max(most, x.back());
    }
    points.x = x;
    points.y = y;
    chart.series = {points,
                    {.name = "sigma = mu*",
                     .x = report::Numbers{0.0, most},
                     .y = report::Numbers{0.0, most},
                     .style = report::Style::line,
                     .muted = true}};
    return chart;
  }

  report::Table table() const {
    report::Table table{
        .title = "Elementary effects",
        .caption =
            screening_.groups.front().mu_star.basis + "; Morris 1991, mu* of Campolongo, Cariboni and Saltelli 2007.",
        .columns = {{"parameter or group"}, {"mu*"}, {"from"}, {"to"}, {"mu"}, {"sigma"}, {"negligible"}}};
    for (const std::size_t k : order_) {
      const ScreenedGroup& g = screening_.groups[k];
      const auto cell = [&](const std::optional<ReportedInterval>& i) {
        return i ? nlohmann::json(value(i->value)) : nlohmann::json(nullptr);
      };
      table.rows.push_back({g.name, value(g.mu_star.value), value(g.mu_star.low), value(g.mu_star.high), cell(g.mu),
                            cell(g.sigma), g.negligible ? "yes" : "no"});
    }
    return table;
  }

  const Study& study_;
  const SensitivityPlan& plan_;
  Screening screening_;
  std::vector<std::size_t> order_;  // of the groups, largest mu_star first
};

}  // namespace

std::unique_ptr<MethodResult> screening_result(const Study& study, const SensitivityPlan& plan,
                                               const SampleStore& store) {
  std::optional<Screening> found = screening(plan, store);
  if (!found) return nullptr;
  return std::make_unique<ScreeningResult>(study, plan, std::move(*found));
}

}  // namespace boresight::app
