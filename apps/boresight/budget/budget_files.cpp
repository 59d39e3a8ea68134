// What a pointing budget's results are as tables and in summary.json.
#include <cmath>
#include <ostream>

#include "budget/budget_parts.hpp"
#include "results/tables.hpp"

namespace boresight::app {
namespace {

Json level_json(const BudgetStudy& s, const BudgetLevel& l, double probability) {
  Json json = {{"index", to_string(l.index)},
               {"axis", s.axes().name(l.axis)},
               {"interpretation", to_string(l.interpretation)},
               {"probability", probability}};
  json.update(interval_json(l.level));
  json["by_rule"] = number_json(l.by_rule);
  json["by_rule_low"] = number_json(l.rule_interval.low);
  json["by_rule_high"] = number_json(l.rule_interval.high);
  if (l.integrated) json["integrated"] = number_json(*l.integrated);
  json["rule_is"] = to_string(l.standing);
  if (const std::string doubt = rule_doubt(s, l); !doubt.empty()) json["rule_doubt"] = doubt;
  json["source"] = kFromMembers;
  return json;
}

}  // namespace

void write_levels(std::ostream& out, const BudgetStudy& s, const Budget& b) {
  out << "index,axis,interpretation,probability,simulated,low,high,by_rule,integrated,standing\n";
  for (const BudgetLevel& l : b.levels)
    out << to_string(l.index) << ',' << csv_field(s.axes().name(l.axis)) << ',' << to_string(l.interpretation) << ','
        << exact(b.headline.probability) << ',' << exact(l.level.value) << ',' << exact(l.level.low) << ','
        << (std::isfinite(l.level.high) ? exact(l.level.high) : "") << ',' << exact(l.by_rule) << ','
        << (l.integrated ? exact(*l.integrated) : "") << ',' << to_string(l.standing) << '\n';
}

void write_classical(std::ostream& out, const BudgetStudy& s, const Budget& b) {
  out << "index,interpretation,contributor,class,group,axis,mean,sd\n";
  for (const ClassicalTable& t : b.tables) {
    const std::string begin = std::string(to_string(t.index)) + ',' + to_string(t.interpretation) + ',';
    const auto row = [&](const std::string& name, const std::string& kind, const std::string& group,
                         const std::vector<Moments>& axes) {
      for (std::size_t a = 0; a < axes.size(); ++a)
        out << begin << csv_field(name) << ',' << csv_field(kind) << ',' << csv_field(group) << ',' << s.axes().name(a)
            << ',' << exact(axes[a].mean) << ',' << exact(axes[a].sd) << '\n';
    };
    for (const ClassicalLine& line : t.lines) row(line.name, line.kind, line.group, line.axes);
    row("total", "total", "", t.total.axes);
  }
}

void write_contributions(std::ostream& out, const Budget& b) {
  const auto bound = [](double value) { return std::isfinite(value) ? exact(value) : std::string(); };
  out << "contribution,kind,share,low,high\n";
  for (const Contribution& c : b.contributions)
    out << csv_field(c.name) << ',' << csv_field(c.kind) << ',' << exact(c.share) << ',' << bound(c.interval.low) << ','
        << bound(c.interval.high) << '\n';
}

Json budget_json(const BudgetStudy& s, const Budget& b) {
  Json json;
  json["members"] = b.members;
  json["failed"] = b.failed;
  json["attribution"] = b.attribution;
  for (const BudgetLevel& l : b.levels) json["levels"].push_back(level_json(s, l, b.headline.probability));
  json["requirements"] = Json::array();
  for (const RequirementAnswer& r : b.requirements) {
    Json one = level_json(s, r.level, r.asked.probability);
    one["limit"] = r.asked.limit;
    if (r.asked.exposure > 0.0) one["exposure"] = r.asked.exposure;
    one["asked_confidence"] = r.asked.confidence;
    one["met"] = r.compliance.met;
    one["met_by_members"] = r.met_by_members;
    one["model_error"] = r.model_error;
    if (r.model_error > 0.0) one["share_within_model_error"] = r.within_error.share;
    one["margin"] = r.margin();
    one["share"] = r.compliance.share;
    one["shown"] = r.compliance.shown;
    one["shown_confidence"] = r.judgement.confidence;
    if (!r.judgement.why.empty()) one["judged"] = r.judgement.why;
    one["fewest_members"] = r.compliance.fewest;
    one["rule_says_met"] = r.rule_says_met();
    json["requirements"].push_back(std::move(one));
  }
  json["contributions"] = Json::array();
  for (const Contribution& c : b.contributions)
    json["contributions"].push_back({{"name", c.name},
                                     {"kind", c.kind},
                                     {"share", number_json(c.share)},
                                     {"low", number_json(c.interval.low)},
                                     {"high", number_json(c.interval.high)}});
  json["tighten_first"] = Json::array();
  for (const ErrorReduction& r : b.reductions)
    json["tighten_first"].push_back({{"name", r.name},
                                     {"if", r.action},
                                     {"before", r.before},
                                     {"after", r.after},
                                     {"gain", r.gain()},
                                     {"gain_low", number_json(r.interval.low)},
                                     {"gain_high", number_json(r.interval.high)},
                                     {"members", r.members},
                                     {"source", source_of(b, r)}});
  if (!b.parts.empty()) json["parts"] = tree_json(b);
  if (!b.jitter.empty()) json["jitter"] = jitter_json(s, b);
  if (!b.spectral.empty()) json["spectra"] = spectra_json(b);
  return json;
}

}  // namespace boresight::app
