#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "boresight/pointing/relative_text.hpp"
#include "budget/budget_parts.hpp"
#include "report_parts/report_parts.hpp"

namespace boresight::app {
namespace {

constexpr double kArcsecPerRadian = 180.0 / std::numbers::pi * 3600.0;

// Numbers of a column; what is rounding beside the largest is zero.
nlohmann::json cell(double value, const DisplayUnit& unit, double largest) {
  constexpr double kRoundingShare = 1e-9;
  if (!std::isfinite(value)) return nullptr;
  return std::abs(value) < kRoundingShare * largest ? 0.0 : value * unit.per_si;
}

std::string spread_text(const Distribution& d, const std::function<std::string(double)>& text) {
  if (d.sd() == 0.0) return text(d.mean()) + " in all";
  std::string out = fmt::format("mean {}, sd {}", text(d.mean()), text(d.sd()));
  if (std::isfinite(d.lowest()) && std::isfinite(d.highest()))
    out += fmt::format(", from {} to {}", text(d.lowest()), text(d.highest()));
  return out;
}

std::string measured_text(const MeasuredCourse& m) {
  std::string out = fmt::format("measured, {} rows over {}", m.record().time.size(), readable(m.length(), "s"));
  out += m.record().begin == MeasuredCourse::Begin::anywhere ? ", each member from a place of its own"
                                                             : ", the same in every member";
  if (m.record().ends != MeasuredCourse::Ends::refused) out += fmt::format("; ends {}", to_string(m.record().ends));
  if (m.jump() > 0.0) out += fmt::format(", with a jump of {} of its range there", readable_share(m.jump()));
  return out;
}

// A standing error over time: its course, and what scatters it.
std::vector<nlohmann::json> of_error_row(const Contributor& c) {
  const ErrorCourse& e = *c.of_error;
  const auto in_unit = [&](double v) { return readable_as(v, e.si_unit, e.unit); };
  std::string spread;
  if (e.course)
    spread = "factor " + (e.factor ? spread_text(*e.factor, [](double v) { return readable_number(v); }) : "1 in all");
  if (e.value)
    spread += (spread.empty() ? "" : "; ") +
              (e.course ? "plus " + spread_text(*e.value, in_unit) : spread_text(*e.value, in_unit));
  return {c.name,
          kind_of(c),
          "error." + e.error + (e.course ? ": " + e.text + " " + e.si_unit : ", constant") + ", seen through the pose",
          spread,
          "all",
          kFromInfluence};
}

}  // namespace

std::string percent(double share) { return fmt::format("{:g} %", 100.0 * share); }

DisplayUnit budget_unit(const BudgetStudy& s, double largest) {
  const std::string written = s.plan.written_unit();
  if (written.empty() && s.study.index.si_unit() == "rad") return {"arcsec", kArcsecPerRadian};
  return display_unit_as(s.study.index.si_unit(), largest, written);
}

std::string interval_text(const BudgetStudy& s, const ReportedInterval& i, const std::string& written) {
  return budget_value(s, i.low, written) + " to " +
         (std::isfinite(i.high) ? budget_value(s, i.high, written) : "no bound");
}

std::string standing_text(RuleStanding standing, double by_rule, double simulated) {
  if (simulated <= 0.0) return to_string(standing);
  const double off = by_rule / simulated - 1.0;
  return off < kSaidAsMultiple ? fmt::format("{}, {:+.0f} %", to_string(standing), 100.0 * off)
                               : fmt::format("{}, {} above", to_string(standing), relative_text(off, 2, "it"));
}

std::string rule_doubt(const BudgetStudy& s, const BudgetLevel& l) {
  if (l.standing != RuleStanding::in_doubt) return "";
  const MemberInterval& ratio = l.rule_over_level;
  const std::string range = std::isfinite(ratio.high)
                                ? fmt::format("{:.2g} to {:.2g} times the level", ratio.low, ratio.high)
                            : ratio.low > 0.0 ? fmt::format("{:.2g} times the level or any more", ratio.low)
                                              : std::string("any multiple of the level");
  return fmt::format("{} leave open whether the rule is fair: with others it may come to {}, with {} confidence",
                     how_many(s.plan.members, "member"), range, percent(s.plan.confidence));
}

const char* source_of(const Budget& b, const ErrorReduction& r) {
  return r.members > b.attribution ? kFromMembers : kFromAttribution;
}

const BudgetLevel& headline_level(const Budget& b) {
  return *std::find_if(b.levels.begin(), b.levels.end(), [&](const BudgetLevel& l) {
    return l.index == b.headline.index && l.interpretation == b.headline.interpretation && l.axis == b.headline.axis;
  });
}

report::Table requirement_table(const BudgetStudy& s, const Budget& b) {
  report::Table table{
      .title = "Requirements",
      .caption =
          "Met only where the members show it at the confidence asked for. Margin: limit less level, over the "
          "limit. The rule's answer is that of the classical table.",
      .columns = {{"Requirement"},
                  {"Limit"},
                  {"Level"},
                  {"Interval"},
                  {"Margin"},
                  {"Shown share"},
                  {"Answer"},
                  {"Classical rule"},
                  {"Source"}}};
  for (const RequirementAnswer& r : b.requirements)
    table.rows.push_back(
        {requirement_title(s, r.asked), budget_limit(s, r.asked.limit, r.asked.unit),
         budget_value(s, r.level.level.value, r.asked.unit), interval_text(s, r.level.level, r.asked.unit),
         readable_share(r.margin() / r.asked.limit),
         r.judgement.by == Judgement::By::nothing
             ? std::string("nothing")
             : fmt::format("{:.4g} % with {} confidence", 100.0 * r.compliance.shown, percent(r.asked.confidence)),
         r.compliance.met ? "met" : "not shown to be met",
         fmt::format("{} ({})", budget_value(s, r.level.by_rule, r.asked.unit), r.rule_says_met() ? "met" : "not met"),
         kFromMembers});
  return table;
}

report::Table level_table(const BudgetStudy& s, const Budget& b) {
  const BudgetAxes axes = s.axes();
  double largest = 0.0;
  for (const BudgetLevel& l : b.levels) largest = std::max(largest, l.level.value);
  const DisplayUnit unit = budget_unit(s, largest);
  report::Table table{
      .title = "Levels in " + unit.name + ", simulated and by rule",
      .caption = fmt::format(
          "Levels that hold with {}; from and to: their {} interval. By rule: one axis |mean| + n_P sd, "
          "the {} by the rule for equal axes without a mean; integrated: the Gaussian with the table's "
          "means and deviations. Unsafe: the rule is more than {:.0f} % below what was simulated; "
          "wasteful: more than {:.0f} % above; both only where other members would not make it fair. In doubt: "
          "other members may make it anything but fair, and these are too few to tell. "
          "Sources: {}, of the rule {}.",
          percent(b.headline.probability), percent(s.plan.confidence), axes.total, 100.0 * (1.0 - kUnsafeBelow),
          100.0 * (kWastefulAbove - 1.0), kFromMembers, kFromClasses),
      .columns = {{"Index, axis"},
                  {"Interpretation"},
                  {"Simulated"},
                  {"from"},
                  {"to"},
                  {"By rule", "", "right"},
                  {"The rule is"},
                  {"Integrated"}}};
  const auto number = [&](double value) { return cell(value, unit, largest); };
  for (const BudgetLevel& l : b.levels)
    table.rows.push_back({std::string(to_string(l.index)) + " " + axes.name(l.axis), to_string(l.interpretation),
                          number(l.level.value), number(l.level.low), number(l.level.high), number(l.by_rule),
                          standing_text(l.standing, l.by_rule, l.level.value),
                          l.integrated ? number(*l.integrated) : nlohmann::json()});
  return table;
}

report::Table contribution_table(const BudgetStudy& s, const Budget& b) {
  const double level = headline_level(b).level.value;
  report::Table table{
      .title = "Shares",
      .caption =
          fmt::format("Of the mean square of the index over members and time; they add up to 100 %. Low and high: "
                      "{} confidence, by the bootstrap over members.",
                      readable_share(s.plan.confidence)),
      .columns = {
          {"Contribution"}, {"Kind"}, {"Share", "%"}, {"Low", "%"}, {"High", "%"}, {"Of the level"}, {"Source"}}};
  const auto percent = [](double share) {
    return std::isfinite(share) ? nlohmann::json(100.0 * share) : nlohmann::json();
  };
  for (const Contribution& c : b.contributions) {
    const bool nominal = c.kind == kClearanceKind, attribution = is_of_group(c.kind) || c.kind == kKnownKind;
    table.rows.push_back({c.name, c.kind, 100.0 * c.share, percent(c.interval.low), percent(c.interval.high),
                          budget_value(s, c.share * level),
                          nominal       ? kFromNominal
                          : attribution ? kFromAttribution
                                        : kFromMembers});
  }
  return table;
}

report::Table relief_table(const BudgetStudy& s, const Budget& b) {
  const double level = headline_level(b).level.value;
  report::Table table{
      .title = "What to tighten first",
      .caption = fmt::format("The level of the members, and what it becomes if one thing is better: contributors are "
                             "taken off every member, standing errors by their columns of influence where these tell "
                             "what the runs do; anything else by runs of their own, of the first {} members. "
                             "Low and high of the gain: {} confidence, by the bootstrap over these members; without a "
                             "high one where they are too few for the probability asked for. Margin then: the gain "
                             "taken off the level of all members.",
                             b.attribution, readable_share(s.plan.confidence)),
      .columns = {{"What"},
                  {"If"},
                  {"Members", "", "right"},
                  {"Level now"},
                  {"Level then"},
                  {"Gain"},
                  {"Gain, low"},
                  {"Gain, high"},
                  {"Margin then"},
                  {"Source"}}};
  const bool asked = headline_answer(b) != nullptr;
  for (const ErrorReduction& r : b.reductions)
    table.rows.push_back(
        {r.name, r.action, r.members, budget_value(s, r.before), budget_value(s, r.after), budget_value(s, r.gain()),
         std::isfinite(r.interval.low) ? budget_value(s, r.interval.low) : "",
         std::isfinite(r.interval.high) ? budget_value(s, r.interval.high) : "",
         asked ? readable_share((b.headline.limit - level + r.gain()) / b.headline.limit) : "", source_of(b, r)});
  return table;
}

report::Table contributor_table(const BudgetStudy& s) {
  report::Table table{
      .title = "Contributors",
      .caption =
          "What is in the budget: clearances follow from the motion, scatter from what the study draws per member, "
          "the others from outside as the study gives them.",
      .columns = {{"Contributor"}, {"Class"}, {"Course in time"}, {"Over the members"}, {"Axes"}, {"Source"}}};
  const MechanismDescription& m = s.mechanism.description();
  for (const ClearanceDescription& c : m.clearances) {
    const bool slider = c.guide == GuideShape::rectangular;
    const bool pad = m.joints[static_cast<std::size_t>(c.joint)].type == JointType::planar;
    table.rows.push_back(
        {m.joints[static_cast<std::size_t>(c.joint)].name, kClearanceKind,
         "the motion's own, " + readable(s.mechanism.duration(), "s"),
         (slider ? "gaps " + readable(c.parameters.width_gap, "m") + " and " + readable(c.parameters.height_gap, "m")
          : pad  ? "gap " + readable(c.parameters.axial, "m")
                 : "radial " + readable(c.parameters.radial, "m") +
                      (c.parameters.axial > 0.0 ? ", axial " + readable(c.parameters.axial, "m") : "")) +
             (pad || slider ? " on each side" : "") + " where nothing else is drawn",
         "all", kFromNominal});
  }
  for (std::size_t g = 0; g < s.plan.groups.names.size(); ++g) {
    std::string spread;
    for (const int i : s.plan.groups.members[g]) {
      const RandomParameter& p = s.plan.inputs.parameters[static_cast<std::size_t>(i)];
      spread += (spread.empty() ? "" : "; ") + (p.name() == s.plan.groups.names[g] ? "" : p.name() + ": ") +
                spread_text(*p.distribution, [&](double v) { return readable_as(v, p.si_unit, p.unit); });
    }
    const std::string kind = kind_of_group(s.plan, g, s.mechanism.description());
    const char* in_time = kind == kScatterKind    ? "fixed in a member"
                          : kind == kGeometryKind ? "fixed in a member, seen through the pose"
                          : kind == kDriveKind    ? "by its law of the drive's coordinate"
                                                  : "fixed in a member, seen through the pose";
    table.rows.push_back({s.plan.groups.names[g], kind, in_time, spread, "all",
                          s.plan.posterior.empty() ? kFromAttribution : kFromCalibration});
  }
  for (const KnownError& known : s.plan.known) {
    const auto at = std::find_if(m.errors.begin(), m.errors.end(),
                                 [&](const ErrorDescription& e) { return known.name == "error." + e.name; });
    table.rows.push_back({known.name, kKnownKind, "fixed, seen through the pose",
                          readable_of_error(known.value, said_unit_of(*at, m.joints)) + " in all", "all",
                          kFromInfluence});
  }
  for (const Contributor& c : s.plan.contributors) {
    if (c.of_error) {
      table.rows.push_back(of_error_row(c));
      continue;
    }
    std::string axes, spread, in_time = c.kind == ContributorClass::bias ? "constant" : "linear";
    if (c.recalibrated) in_time += ", anew with every observation";
    if (c.kind == ContributorClass::periodic) in_time = "period " + readable(c.period, "s");
    if (c.kind == ContributorClass::spectrum)
      in_time = "stationary noise by its spectrum, deviation " + budget_value(s, std::sqrt(c.noise->power_from(0.0)));
    if (c.measured) in_time = measured_text(*c.measured);
    if (c.kind == ContributorClass::random) in_time = "correlation time " + readable(c.correlation_time, "s");
    for (std::size_t a = 0; a < 3; ++a) {
      if (!c.parameter[a]) continue;
      axes += fmt::format("{}{}", axes.empty() ? "" : ", ", "xyz"[a]);
      const std::string per = c.kind == ContributorClass::drift ? "/s" : "";
      const bool factor = c.kind == ContributorClass::spectrum || c.kind == ContributorClass::measured;
      spread = factor ? "factor " + spread_text(*c.parameter[a], [](double v) { return readable_number(v); })
                      : spread_text(*c.parameter[a], [&](double v) { return budget_value(s, v) + per; });
    }
    if (c.frame != Mat3::Identity()) axes += " of its own frame";
    if (c.axes_factor != Mat3::Identity()) axes += ", correlated";
    if (c.through) in_time += ", through its transfer functions once settled";
    table.rows.push_back({c.name, to_string(c.kind), in_time, spread, axes, kFromClasses});
  }
  return table;
}

report::Table classical_table(const BudgetStudy& s, const ClassicalTable& t) {
  const BudgetAxes axes = s.axes();
  double largest = 0.0;
  for (const Moments& m : t.total.axes) largest = std::max({largest, std::abs(m.mean), m.sd});
  const DisplayUnit unit = budget_unit(s, largest);
  report::Table table{
      .title = fmt::format("Classical table: {}, {}", to_string(t.index), to_string(t.interpretation)),
      .caption =
          "Means add linearly, deviations by root sum of squares, linearly within a group. Clearances: the "
          "motion at the medians, one joint open at a time. Scatter: what mean and variance lose with the group "
          "held at its medians. Standing errors: by their columns of influence; those that scatter by runs without "
          "them, where the columns do not tell what these do. "
          "Others: by their class, with exact window filters.",
      .columns = {{"Contributor"}, {"Class"}, {"Group"}}};
  for (const std::string& name : axes.names) {
    table.columns.push_back({"mean " + name, unit.name});
    table.columns.push_back({"sd " + name, unit.name});
  }
  table.columns.push_back({"Source"});
  const auto row = [&](std::vector<nlohmann::json> cells, const std::vector<Moments>& moments, const char* source) {
    for (const Moments& m : moments) {
      cells.push_back(cell(m.mean, unit, largest));
      cells.push_back(cell(m.sd, unit, largest));
    }
    cells.emplace_back(source);
    table.rows.push_back(std::move(cells));
  };
  for (const ClassicalLine& line : t.lines)
    row({line.name, line.kind, line.group}, line.axes,
        line.kind == kClearanceKind  ? kFromNominal
        : is_of_group(line.kind)     ? (line.of_all_members ? kFromMembers : kFromAttribution)
        : is_by_influence(line.kind) ? kFromInfluence
                                     : kFromClasses);
  row({"total", "", ""}, t.total.axes, kFromClasses);
  return table;
}

report::Table source_table(const BudgetStudy& s) {
  const MechanismDescription& m = s.mechanism.description();
  const std::string rung = s.rung.name + (s.step > 0.0 ? ", step " + readable(s.step, "s") : "");
  report::Table table{
      .title = "Sources",
      .caption =
          "Every table names its sources by these letters. Runs are numbers in samples.db beside this file; a "
          "member's runs and external errors follow from study, mechanism, rung, seed and number alone.",
      .columns = {{"Source"},
                  {"What"},
                  {"Runs"},
                  {"Store"},
                  {"Rung"},
                  {"Seed"},
                  {"Study"},
                  {"Study hash"},
                  {"Mechanism hash"}}};
  for (const BudgetSource& source : budget_sources(s))
    table.rows.push_back({source.letter, source.what, source.runs, source.runs.empty() ? "" : "samples.db",
                          source.runs.empty() ? "" : rung, std::to_string(s.plan.seed), s.study.file,
                          s.study.content_hash.substr(0, 12), m.content_hash.substr(0, 12)});
  return table;
}

}  // namespace boresight::app
