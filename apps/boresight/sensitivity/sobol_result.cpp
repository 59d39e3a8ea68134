// Sobol' indices as the sensitivity verb tells them.
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

// Groups by what they make, largest first.
std::vector<std::size_t> by_total(const GlobalSensitivity& global) {
  std::vector<std::size_t> order(global.groups.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return global.groups[a].total.value > global.groups[b].total.value;
  });
  return order;
}

report::Chart index_chart(const GlobalSensitivity& global, double confidence) {
  report::Chart chart{
      .title = "Share of the variance that each makes",
      .caption = fmt::format("First order: what it makes alone; total: alone and together with all others. Whiskers: "
                             "{:g} % intervals. An index may come out a little below zero where it is zero.",
                             100.0 * confidence),
      .x = {"parameter or group", ""},
      .y = {"share of the variance", ""},
      .height = 420};
  report::Names names;
  report::Series first{.name = "first order", .style = report::Style::bars},
      total{.name = "total", .style = report::Style::bars};
  report::Numbers y1, yt;
  for (const std::size_t g : by_total(global)) {
    const GroupSensitivity& s = global.groups[g];
    names.push_back(s.name);
    y1.push_back(s.first.value);
    yt.push_back(s.total.value);
    first.error_low.push_back(s.first.value - s.first.low);
    first.error_high.push_back(s.first.high - s.first.value);
    total.error_low.push_back(s.total.value - s.total.low);
    total.error_high.push_back(s.total.high - s.total.value);
  }
  first.x = total.x = names;
  first.y = y1;
  total.y = yt;
  chart.series = {first, total};
  return chart;
}

report::Table index_table_of(const GlobalSensitivity& global) {
  report::Table table{
      .title = "Sobol' indices",
      .caption = global.groups.front().first.basis +
                 "; estimators of Saltelli et al. 2010 (first) and Jansen "
                 "1999 (total).",
      .columns = {{"parameter or group"}, {"first"}, {"from"}, {"to"}, {"total"}, {"from"}, {"to"}, {"settled"}}};
  for (const std::size_t g : by_total(global)) {
    const GroupSensitivity& s = global.groups[g];
    table.rows.push_back({s.name, s.first.value, s.first.low, s.first.high, s.total.value, s.total.low, s.total.high,
                          s.undersampled ? "no: more samples" : "yes"});
  }
  const ReportedInterval& i = global.interactions;
  table.rows.push_back({"only together (1 - sum of first)", i.value, i.low, i.high, nullptr, nullptr, nullptr, ""});
  return table;
}

class SobolResult final : public MethodResult {
 public:
  SobolResult(const Study& study, const SensitivityPlan& plan, GlobalSensitivity global)
      : study_(study), plan_(plan), global_(std::move(global)) {}

  RowCounts counts() const override { return global_; }
  std::string sentence() const override;
  std::vector<report::Fact> facts() const override {
    return {{"mean of the index", readable(global_.mean, study_.index.si_unit()), "", ""},
            {"standard deviation", readable(global_.sd, study_.index.si_unit()), "", ""},
            {"only together", share_text(global_.interactions.value), "",
             fmt::format("({} to {}) of the variance, by no parameter alone", share_text(global_.interactions.low),
                         share_text(global_.interactions.high))}};
  }
  report::Section section() const override {
    report::Section section{
        .id = "indices",
        .title = "Whose scatter matters",
        .intro = fmt::format("The index is the {}. Over the whole scatter it has the mean {} and the standard "
                             "deviation {}; its variance is divided among the parameters here.",
                             study_.index.title(), readable(global_.mean, study_.index.si_unit()),
                             readable(global_.sd, study_.index.si_unit()))};
    section.items.push_back(index_chart(global_, plan_.confidence));
    section.items.push_back(index_table_of(global_));
    return section;
  }
  std::vector<std::string> warnings() const override {
    std::string unsettled;
    for (const GroupSensitivity& g : global_.groups)
      if (g.undersampled) unsettled += (unsettled.empty() ? "" : ", ") + g.name;
    if (unsettled.empty()) return {};
    return {"under-sampled (an interval wholly below zero, or wider than 0.2): " + unsettled +
            "; more samples settle it"};
  }
  void add_to(Json& json) const override {
    json["index"]["mean"] = global_.mean;
    json["index"]["sd"] = global_.sd;
    for (std::size_t g = 0; g < plan_.groups.size(); ++g) {
      const GroupSensitivity& group = global_.groups[g];
      json["sobol"][group.name] = {{"parameters", parameters_of(plan_, g)},
                                   {"first", interval_json(group.first)},
                                   {"total", interval_json(group.total)},
                                   {"undersampled", group.undersampled}};
    }
    json["interactions"] = interval_json(global_.interactions);
    json["basis"] = global_.interactions.basis;
  }
  std::string table_name() const override { return "sobol.csv"; }
  void write_table(std::ostream& out) const override {
    out << "group,first,first_low,first_high,total,total_low,total_high,undersampled\n";
    for (const GroupSensitivity& g : global_.groups) {
      out << csv_field(g.name);
      for (const ReportedInterval& i : {g.first, g.total})
        out << ',' << exact(i.value) << ',' << exact(i.low) << ',' << exact(i.high);
      out << ',' << (g.undersampled ? "true" : "false") << '\n';
    }
  }
  void print(const std::string& rung) const override {
    tell("  index: {}; mean {}, standard deviation {}; {} rung\n", study_.index.title(),
         readable(global_.mean, study_.index.si_unit()), readable(global_.sd, study_.index.si_unit()), rung);
    const std::size_t widest = widest_of(global_.groups, [](const GroupSensitivity& g) { return g.name; });
    for (const GroupSensitivity& g : global_.groups)
      tell("  {}  first {:>6} ({} to {})   total {:>6} ({} to {})\n", padded(g.name, widest), share_text(g.first.value),
           share_text(g.first.low), share_text(g.first.high), share_text(g.total.value), share_text(g.total.low),
           share_text(g.total.high));
  }

 private:
  const Study& study_;
  const SensitivityPlan& plan_;
  GlobalSensitivity global_;
};

std::string SobolResult::sentence() const {
  if (global_.sd <= 1e-9 * std::abs(global_.mean)) return "The index does not depend on what scatters.";
  std::vector<MeasuredGroup> totals;
  for (const GroupSensitivity& g : global_.groups) totals.push_back({g.name, g.total});
  const std::vector<MeasuredGroup> leading = leading_groups(totals);
  const GroupSensitivity& first = global_.groups[by_total(global_).front()];
  const std::string aside = "; an estimate of a share may come out a little below 0 or above 1";
  if (leading.size() > 1) {
    const bool beyond = std::any_of(leading.begin(), leading.begin() + static_cast<std::ptrdiff_t>(named(leading)),
                                    [](const MeasuredGroup& g) { return g.measure.low < 0.0 || g.measure.high > 1.0; });
    return fmt::format(
        "{} matter most; these samples do not tell them apart: their shares of the variance, with all that each does "
        "together with others, are {}{}",
        names_of(leading), measures_of(leading, share_text), beyond ? aside : "");
  }
  // The numbers of the table. Estimates of what lies between 0 and 1 may lie beyond, and that is said.
  const bool beyond =
      std::min(first.first.low, first.total.low) < 0.0 || std::max(first.first.high, first.total.high) > 1.0;
  return fmt::format(
      "{} matters most: its share of the variance is {} alone ({} to {}) and {} with all it does together with others "
      "({} to {}){}",
      first.name, share_text(first.first.value), share_text(first.first.low), share_text(first.first.high),
      share_text(first.total.value), share_text(first.total.low), share_text(first.total.high), beyond ? aside : "");
}

}  // namespace

std::unique_ptr<MethodResult> sobol_result(const Study& study, const SensitivityPlan& plan, const SampleStore& store) {
  std::optional<GlobalSensitivity> global = global_sensitivity(plan, store);
  if (!global) return nullptr;
  return std::make_unique<SobolResult>(study, plan, std::move(*global));
}

}  // namespace boresight::app
