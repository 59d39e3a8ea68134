#include "allocate/allocate_results.hpp"

#include <ostream>

#include "results/scatter_parts.hpp"
#include "results/tables.hpp"

namespace boresight::app {
namespace {

Json allocation_json(const AllocateStudy& s, const Allocation& a) {
  Json json = {{"feasible", a.feasible},
               {"price", number_json(a.price)},
               {"share_within", number_json(a.share_within)},
               {"least_limit_shown", number_json(a.reached)},
               {"meets", a.meets},
               {"proven", a.proven},
               {"bound", number_json(a.bound)},
               {"nodes", a.nodes},
               {"standing", standing_of(s, a)}};
  json["choice"] = Json::object();
  if (!a.choice.empty() || !a.tolerance.empty())
    for (std::size_t j = 0; j < s.plan.entries.size(); ++j)
      for (const std::string& path : s.plan.entries[j].paths)
        json["choice"][path] = s.plan.entries[j].is_continuous() ? Json(a.tolerance[j]) : Json(option_text(s, a, j));
  return json;
}

// The mean gap that a fit or a tolerance gives; of an error, its middle.
Json optimum_json(const AllocateStudy& s) {
  Json json = Json::object();
  const Allocation& a = s.result.chosen;
  if (a.choice.empty() && a.tolerance.empty()) return json;
  for (std::size_t j = 0; j < s.plan.entries.size(); ++j)
    for (const std::string& path : s.plan.entries[j].paths)
      json[path] = s.plan.entries[j].is_continuous()
                       ? s.plan.entries[j].zone(a.tolerance[j], s.plan.zone)->mean()
                       : s.plan.entries[j].options[static_cast<std::size_t>(a.choice[j])].gap->mean();
  return json;
}

}  // namespace

Json allocate_summary(const AllocateStudy& s, const VerbStudy& own, const Stopwatch& watch,
                      const SampleStore::Cost& earlier) {
  const AllocationResult& r = s.result;
  Json json = own.head(s.study, s.rung, watch, s.warnings, r.interrupted, earlier);
  json["seed"] = s.plan.seed;
  json["optimum"] = optimum_json(s);
  json["optimum_of"] = "mean radial clearance per joint, middle of each error's zone";
  json["objective"] = number_json(r.chosen.price);
  json["converged"] = r.converged && r.feasible;
  json["feasible"] = r.feasible;
  json["best_reachable"] = r.feasible ? Json() : number_json(r.best_reachable);
  json["evaluations"] = r.evaluations;
  json["evaluations_reused"] = r.reused;
  json["samples_of_search"] = s.plan.samples;
  json["search_seconds"] = r.search_seconds;
  json["why"] = r.chosen.why;
  json["requirement"] = {{"limit", s.plan.requirement.limit},
                         {"probability", s.plan.requirement.probability},
                         {"confidence", s.plan.requirement.confidence}};
  json["linear_misfit"] = r.misfit;
  json["factor"] = r.factor;
  json["chosen"] = allocation_json(s, r.chosen);
  json["worst_case"] = allocation_json(s, r.worst_case);
  json["root_sum_square"] = allocation_json(s, r.root_sum_square);
  json["shares"] = Json::array();
  for (const AllocationShare& share : r.shares)
    json["shares"].push_back({{"joint", share.joint},
                              {"price", share.price},
                              {"cost_share", share.cost_share},
                              {"error_share", share.error_share},
                              {"next_saving", share.next_saving}});
  json["front"] = Json::array();
  for (const CostPoint& p : r.front)
    json["front"].push_back({{"limit", p.limit}, {"price", number_json(p.price)}, {"feasible", p.feasible}});
  json["last_micrometre"] = number_json(r.last_micrometre);
  json["confirmations"] = Json::array();
  for (const AllocationConfirmation& c : r.confirmations)
    json["confirmations"].push_back({{"rung", c.rung},
                                     {"seed", c.seed},
                                     {"samples", c.samples},
                                     {"failed", c.failed},
                                     {"confidence", c.confidence},
                                     {"factor", c.factor},
                                     {"price", c.price},
                                     {"model_error", c.model_error},
                                     {"share_within", c.share_within},
                                     {"share_low", c.share_low},
                                     {"least_limit_shown", number_json(c.reached)},
                                     {"met", c.met},
                                     {"agrees", c.agrees},
                                     {"sentence", c.sentence}});
  json["files"] = {"summary.json", "allocation.csv", "confirmation.db", "report.html", "report.json"};
  return json;
}

void write_allocation(std::ostream& out, const AllocateStudy& s) {
  out << "joint,option,tolerance,price,cost_share,error_share,worst_case,root_sum_square\n";
  for (std::size_t j = 0; j < s.result.shares.size(); ++j) {
    const AllocationShare& share = s.result.shares[j];
    out << csv_field(share.joint) << ',' << csv_field(share.option) << ','
        << (s.plan.entries[j].is_continuous() ? exact(s.result.chosen.tolerance[j]) : "") << ',' << exact(share.price)
        << ',' << exact(share.cost_share) << ',' << exact(share.error_share);
    for (const Allocation* a : {&s.result.worst_case, &s.result.root_sum_square})
      out << ',' << (a->feasible ? csv_field(option_text(s, *a, j)) : "");
    out << '\n';
  }
}

}  // namespace boresight::app
