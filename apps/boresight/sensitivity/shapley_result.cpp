// Shapley effects as the sensitivity verb tells them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ostream>

#include "results/scatter_parts.hpp"
#include "results/tables.hpp"
#include "sensitivity/leading_groups.hpp"
#include "sensitivity/method_result.hpp"
#include "terminal/columns.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

class ShapleyResult final : public MethodResult {
 public:
  ShapleyResult(const Study& study, const SensitivityPlan& plan, ShapleyDivision division)
      : study_(study), plan_(plan), division_(std::move(division)), order_(division_.groups.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      return division_.groups[a].effect.value > division_.groups[b].effect.value;
    });
  }

  RowCounts counts() const override { return division_; }
  std::string sentence() const override {
    if (division_.sd <= 1e-9 * std::abs(division_.mean)) return "The index does not depend on what scatters.";
    std::vector<MeasuredGroup> effects;
    for (const ShapleyGroup& g : division_.groups) effects.push_back({g.name, g.effect});
    const std::vector<MeasuredGroup> leading = leading_groups(effects);
    if (leading.size() > 1)
      return fmt::format("{} matter most; these samples do not tell them apart: their shares of the variance are {}",
                         names_of(leading), measures_of(leading, share_text));
    const ShapleyGroup& first = division_.groups[order_.front()];
    return fmt::format("{} matters most: its share of the variance is {} ({} to {})", first.name,
                       share_text(first.effect.value), share_text(first.effect.low), share_text(first.effect.high));
  }
  std::vector<report::Fact> facts() const override {
    return {{"mean of the index", readable(division_.mean, study_.index.si_unit()), "", ""},
            {"standard deviation", readable(division_.sd, study_.index.si_unit()), "", ""}};
  }
  report::Section section() const override {
    report::Section section{
        .id = "shapley",
        .title = "Whose scatter matters",
        .intro = fmt::format(
            "The index is the {}. Over the whole scatter it has the mean {} and the standard deviation {}. Its "
            "variance is "
            "divided among the parameters so that the shares add up to one although some of them depend on each other: "
            "each is paid what it adds to the variance explained, on average over {} orders in which parameters may be "
            "taken in. A parameter that does nothing itself has a share where it tells about one that does.",
            study_.index.title(), readable(division_.mean, study_.index.si_unit()),
            readable(division_.sd, study_.index.si_unit()),
            plan_.shapley->orders() == ShapleyOrders::all ? "all" : "random")};
    section.items.push_back(chart());
    section.items.push_back(table());
    return section;
  }
  std::vector<std::string> warnings() const override {
    std::string unsettled;
    for (const ShapleyGroup& g : division_.groups)
      if (g.undersampled) unsettled += (unsettled.empty() ? "" : ", ") + g.name;
    if (unsettled.empty()) return {};
    return {fmt::format(
        "under-sampled (an interval wider than {:g}): {}; about {:.2g} samples make every interval as narrow",
        ShapleyDivision::kWideEffect, unsettled, division_.rows_that_settle())};
  }
  void add_to(Json& json) const override {
    json["index"]["mean"] = division_.mean;
    json["index"]["sd"] = division_.sd;
    for (std::size_t g = 0; g < division_.groups.size(); ++g) {
      const ShapleyGroup& group = division_.groups[g];
      json["shapley"][group.name] = {{"parameters", parameters_of(plan_, g)},
                                     {"effect", interval_json(group.effect)},
                                     {"undersampled", group.undersampled}};
    }
    json["orders"] = plan_.shapley->orders() == ShapleyOrders::all ? "all" : "random";
    json["basis"] = division_.groups.front().effect.basis;
  }
  std::string table_name() const override { return "shapley.csv"; }
  void write_table(std::ostream& out) const override {
    out << "group,effect,effect_low,effect_high,undersampled\n";
    for (const ShapleyGroup& g : division_.groups)
      out << csv_field(g.name) << ',' << exact(g.effect.value) << ',' << exact(g.effect.low) << ','
          << exact(g.effect.high) << ',' << (g.undersampled ? "true" : "false") << '\n';
  }
  void print(const std::string& rung) const override {
    tell("  index: {}; mean {}, standard deviation {}; {} rung\n", study_.index.title(),
         readable(division_.mean, study_.index.si_unit()), readable(division_.sd, study_.index.si_unit()), rung);
    const std::size_t widest = widest_of(division_.groups, [](const ShapleyGroup& g) { return g.name; });
    for (const std::size_t k : order_) {
      const ShapleyGroup& g = division_.groups[k];
      tell("  {}  Shapley effect {:>6} ({} to {})\n", padded(g.name, widest), share_text(g.effect.value),
           share_text(g.effect.low), share_text(g.effect.high));
    }
  }

 private:
  report::Chart chart() const {
    report::Chart chart{.title = "Share of the variance of each",
                        .caption = fmt::format("Shapley effects, which add up to one. Whiskers: {:g} % intervals.",
                                               100.0 * plan_.confidence),
                        .x = {"share of the variance", ""},
                        .y = {"parameter or group", ""},
                        .height = report::height_of_bars(order_.size(), 40)};
    report::Series series{.name = "Shapley effect", .style = report::Style::bars};
    report::Names names;
    report::Numbers shares;
    for (const std::size_t k : order_) {
      const ShapleyGroup& g = division_.groups[k];
      names.push_back(g.name);
      shares.push_back(g.effect.value);
      series.error_low.push_back(g.effect.value - g.effect.low);
      series.error_high.push_back(g.effect.high - g.effect.value);
    }
    series.x = shares;
    series.y = names;
    chart.series = {series};
    return chart;
  }

  report::Table table() const {
    report::Table table{.title = "Shapley effects",
                        .caption = division_.groups.front().effect.basis + "; Song, Nelson and Staum 2016.",
                        .columns = {{"parameter or group"}, {"effect"}, {"from"}, {"to"}, {"settled"}}};
    for (const std::size_t k : order_) {
      const ShapleyGroup& g = division_.groups[k];
      table.rows.push_back(
          {g.name, g.effect.value, g.effect.low, g.effect.high, g.undersampled ? "no: more samples" : "yes"});
    }
    return table;
  }

  const Study& study_;
  const SensitivityPlan& plan_;
  ShapleyDivision division_;
  std::vector<std::size_t> order_;  // of the groups, largest effect first
};

}  // namespace

std::unique_ptr<MethodResult> shapley_result(const Study& study, const SensitivityPlan& plan,
                                             const SampleStore& store) {
  std::optional<ShapleyDivision> found = shapley_division(plan, store);
  if (!found) return nullptr;
  return std::make_unique<ShapleyResult>(study, plan, std::move(*found));
}

}  // namespace boresight::app
