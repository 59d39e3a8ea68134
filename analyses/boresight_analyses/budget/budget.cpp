#include "boresight_analyses/budget/budget.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/budget/ensemble.hpp"
#include "boresight_analyses/budget/member_shares.hpp"
#include "boresight_analyses/montecarlo/looks.hpp"

namespace boresight {
namespace {

constexpr std::size_t kShown = 40;  // members whose histories a chart may draw

using Values = std::vector<std::vector<Vec3>>;  // of an index, per member

// `with` less `without`, value by value: the part of what adds up.
Values difference_of(const Values& with, const Values& without) {
  Values out = with;
  for (std::size_t m = 0; m < out.size(); ++m)
    for (std::size_t k = 0; k < out[m].size(); ++k) out[m][k] -= without[m][k];
  return out;
}

double mean_product(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const AxisOf& axis) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += axis.product(a[k], b[k]);
  return sum / static_cast<double>(a.size());
}

class Maker {
 public:
  Maker(const BudgetPlan& plan, const BudgetRuns& runs, const Mechanism& mechanism, PointingQuantity quantity,
        const SampleStore& store, const std::vector<Judgement>& judgements, double of_steps)
      : plan_(plan),
        runs_(runs),
        judgements_(judgements),
        of_steps_(std::isfinite(of_steps) ? of_steps : 0.0),
        axes_(quantity),
        ensemble_(plan, runs, store) {
    for (const ClearanceDescription& c : mechanism.description().clearances)
      joints_.push_back(mechanism.description().joints[static_cast<std::size_t>(c.joint)].name);
    for (std::size_t g = 0; g < runs.groups(); ++g) kinds_.push_back(kind_of_group(plan, g, mechanism.description()));
    nominal_ = stored_history(store, runs.nominal(), plan);
    if (nominal_.error.empty())
      throw ComputationError("the motion with every scattered parameter at its median could not be followed");
    for (std::size_t j = 0; j < joints_.size(); ++j) alone_.push_back(stored_history(store, runs.alone(j), plan));
    for (std::uint64_t member = 0; member < plan.members; ++member) {
      PointingHistory total = ensemble_.total(member);
      if (total.error.empty()) continue;
      totals_.push_back(std::move(total));
      members_.push_back(member);
    }
    if (totals_.empty()) throw ComputationError("no member of the ensemble could be followed");
    failed_ = static_cast<std::int64_t>(plan.members - totals_.size());
    attribution_ = runs.rows() == 1 ? plan.attribution : runs.attribution();
    groups_.emplace(plan, runs, ensemble_, members_);
    for (const PointingHistory& total : totals_)
      for (const Vec3& e : total.error) largest_ = std::max(largest_, e.norm());
  }

  Budget make() {
    Budget b;
    b.headline = plan_.headline(axes_);
    b.members = static_cast<std::int64_t>(plan_.members);
    b.failed = failed_;
    b.attribution = attribution_;
    b.nominal = nominal_;
    b.requirements.resize(plan_.requirements.size());
    b.shown.assign(totals_.begin(), totals_.begin() + static_cast<std::ptrdiff_t>(std::min(kShown, totals_.size())));
    for (const ErrorIndex index : plan_.indices()) {
      for (ClassicalTable& t : classical_tables(plan_, classical_parts(), index, plan_.windows))
        b.tables.push_back(std::move(t));
      const Values values = values_of(totals_, index, plan_.windows);
      for (std::size_t axis = 0; axis <= axes_.count(); ++axis) {
        const EnsembleInTime sizes = in_time(values, axis, failed_);
        for (const Interpretation i : kInterpretations)
          b.levels.push_back(level(sizes, table(b, index, i), axis, b.headline.probability, plan_.confidence));
        for (std::size_t r = 0; r < plan_.requirements.size(); ++r)
          if (plan_.requirements[r].index == index && plan_.requirements[r].axis == axis &&
              plan_.requirements[r].exposure == 0.0)
            b.requirements[r] = answer(r, sizes, table(b, index, plan_.requirements[r].interpretation), plan_.windows);
        if (b.headline.index == index && b.headline.axis == axis)
          for (const std::vector<Vec3>& v : values) b.headline_sizes.push_back(sizes_of(v, {axis, axes_.count()}));
      }
    }
    for (std::size_t r = 0; r < plan_.requirements.size(); ++r) {
      const BudgetRequirement& asked = plan_.requirements[r];
      if (asked.exposure == 0.0) continue;
      const Windows windows = plan_.windows_of(asked);
      const Values values = values_of(totals_, asked.index, windows);
      const std::vector<ClassicalTable> tables = classical_tables(plan_, classical_parts(), asked.index, windows);
      b.requirements[r] = answer(r, in_time(values, asked.axis, failed_),
                                 tables[static_cast<std::size_t>(asked.interpretation)], windows);
    }
    b.parts = sub_budgets(
        plan_, ensemble_, of_steps_, axes_, table(b, b.headline.index, b.headline.interpretation).lines,
        judgements_.empty()
            ? judgements_
            : std::vector<Judgement>(judgements_.begin() + static_cast<std::ptrdiff_t>(plan_.requirements.size()),
                                     judgements_.end()));
    b.jitter = jitter_curves(plan_, totals_, axes_.count());
    contribute(b);
    b.reductions = error_reductions(plan_, {axes_, b.headline, joints_, runs_, ensemble_, *groups_, totals_, members_,
                                            runs_.rows() == 1 ? plan_.members : attribution_});
    return b;
  }

 private:
  Values values_of(const std::vector<PointingHistory>& histories, ErrorIndex index, const Windows& windows) const {
    Values values;
    for (const PointingHistory& h : histories) values.push_back(index_values(index, h, windows));
    return values;
  }

  EnsembleInTime in_time(const Values& values, std::size_t axis, std::int64_t failed) const {
    std::vector<std::vector<double>> sizes;
    for (const std::vector<Vec3>& v : values) sizes.push_back(sizes_of(v, {axis, axes_.count()}));
    return EnsembleInTime(std::move(sizes), failed);
  }

  static const ClassicalTable& table(const Budget& b, ErrorIndex index, Interpretation interpretation) {
    return *std::find_if(b.tables.begin(), b.tables.end(), [&](const ClassicalTable& t) {
      return t.index == index && t.interpretation == interpretation;
    });
  }

  BudgetLevel level(const EnsembleInTime& sizes, const ClassicalTable& t, std::size_t axis, double probability,
                    double confidence) const {
    BudgetLevel l{.index = t.index, .interpretation = t.interpretation, .axis = axis};
    l.level = sizes.level(t.interpretation, probability, confidence, plan_.leave_out);
    const bool total = axis == axes_.count();
    l.by_rule = t.by_rule(axis, probability);
    l.rule_interval = t.rule_interval(axis, probability, plan_.confidence);
    if (total && t.interpretation != Interpretation::ensemble) l.integrated = t.total.radius_integrated(probability);
    constexpr double kRounding = 1e-9;  // of the largest error
    // Where nothing scatters others would be the same.
    const bool all_alike = plan_.inputs.size() == 0 && plan_.contributors.empty();
    const MemberInterval simulated =
        all_alike ? MemberInterval{l.level.value, l.level.value}
                  : sizes.about_level(t.interpretation, probability, plan_.confidence, plan_.leave_out);
    l.standing = standing_of({l.by_rule, l.rule_interval}, {l.level.value, simulated}, kRounding * largest_);
    l.rule_over_level = rule_over_simulated(l.rule_interval, simulated);
    return l;
  }

  ClassicalParts classical_parts() const { return {axes_, joints_, kinds_, alone_, *groups_}; }

  // sizes: of the asked index along the asked axis.
  RequirementAnswer answer(std::size_t r, const EnsembleInTime& sizes, const ClassicalTable& t,
                           const Windows& windows) const {
    const BudgetRequirement& asked = plan_.requirements[r];
    const Judgement judgement =
        judgements_.empty() ? Judgement{.confidence = asked.confidence, .why = ""} : judgements_[r];
    const auto judged = [&](const EnsembleInTime& of) {
      return of.compliance(asked.interpretation, asked.limit, asked.probability, judgement, plan_.leave_out);
    };
    RequirementAnswer answer{.asked = asked,
                             .level = level(sizes, t, asked.axis, asked.probability, asked.confidence),
                             .compliance = judged(sizes),
                             .judgement = judgement};
    answer.met_by_members = answer.compliance.met;
    std::vector<double> missed;
    const AxisOf axis(asked.axis, axes_.count());
    for (std::size_t m = 0; m < members_.size(); ++m) {
      const double error = of_steps_ + ensemble_.model_error(members_[m]);
      answer.model_error = std::max(answer.model_error, error);
      missed.push_back(missed_of(ensemble_, members_[m], error, asked.index, windows, axis));
    }
    if (!(answer.model_error > 0.0)) return answer;
    answer.within_error = judged(sizes.raised(missed));
    answer.compliance.met = answer.met_by_members && answer.within_error.met;
    return answer;
  }

  // Members of the attribution for which both runs are there; the mechanism's part alone, of one index.
  std::pair<Values, Values> with_and_without(const MemberVariant& variant, ErrorIndex index,
                                             const Windows& windows) const {
    std::pair<Values, Values> out;
    for (std::uint64_t member = 0; member < runs_.attribution(); ++member) {
      const PointingHistory *drawn = ensemble_.mechanism(member), *changed = ensemble_.mechanism(member, variant);
      if (drawn == nullptr || changed == nullptr) continue;
      out.first.push_back(index_values(index, *drawn, windows));
      out.second.push_back(index_values(index, *changed, windows));
    }
    return out;
  }

  MemberProducts products(const Budget& b) const {
    const AxisOf axis(b.headline.axis, axes_.count());
    const ErrorIndex index = b.headline.index;
    MemberProducts p;
    p.external.resize(plan_.contributors.size());
    for (std::uint64_t member = 0; member < plan_.members; ++member) {
      const PointingHistory* mechanism = ensemble_.mechanism(member);
      if (mechanism == nullptr) continue;
      const std::vector<Vec3> total = index_values(index, ensemble_.total(member), plan_.windows);
      p.all.push_back(mean_product(total, total, axis));
      p.own.push_back(mean_product(index_values(index, *mechanism, plan_.windows), total, axis));
      for (std::size_t i = 0; i < p.external.size(); ++i)
        p.external[i].push_back(
            mean_product(index_values(index, ensemble_.external(member, i), plan_.windows), total, axis));
    }
    const std::vector<Vec3> nominal = index_values(index, nominal_, plan_.windows);
    for (const PointingHistory& alone : alone_)
      p.alone.push_back(alone.error.empty() ? std::nan("")
                                            : mean_product(index_values(index, alone, plan_.windows), nominal, axis));
    for (std::size_t g = 0; g < runs_.groups(); ++g) {
      const auto [drawn, held] = with_and_without({.held = static_cast<int>(g)}, index, plan_.windows);
      auto& change = p.change.emplace_back();
      auto& of_same = p.of_same.emplace_back();
      if (plan_.is_of_errors(g)) {
        const Values part = difference_of(drawn, held);
        for (std::size_t k = 0; k < drawn.size(); ++k) {
          change.push_back(mean_product(part[k], drawn[k], axis));
          of_same.push_back(mean_product(drawn[k], drawn[k], axis));
        }
        continue;
      }
      for (std::size_t k = 0; k < drawn.size(); ++k)
        change.push_back(mean_product(drawn[k], drawn[k], axis) - mean_product(held[k], held[k], axis));
    }
    for (const KnownError& known : plan_.known) {
      const std::vector<Vec3> part = index_values(index, known.history, plan_.windows);
      auto& change = p.change.emplace_back();
      auto& of_same = p.of_same.emplace_back();
      for (std::uint64_t member = 0; member < runs_.attribution(); ++member) {
        const PointingHistory* drawn = ensemble_.mechanism(member);
        if (drawn == nullptr) continue;
        const std::vector<Vec3> values = index_values(index, *drawn, plan_.windows);
        change.push_back(mean_product(part, values, axis));
        of_same.push_back(mean_product(values, values, axis));
      }
    }
    return p;
  }

  void contribute(Budget& b) const {
    const MemberProducts p = products(b);
    b.mean_square = std::accumulate(p.all.begin(), p.all.end(), 0.0) / static_cast<double>(p.all.size());
    if (b.mean_square <= 0.0) return;
    std::size_t attributed = 0;
    for (const auto& change : p.change) attributed = std::max(attributed, change.size());
    const std::vector<double> found =
        shares(p, std::vector<std::uint32_t>(p.all.size(), 1), std::vector<std::uint32_t>(attributed, 1));
    std::vector<std::vector<double>> resampled(found.size());
    const MemberBootstrap members(p.all.size(), plan_.seed, 1),
        of_attribution(std::max<std::size_t>(1, attributed), plan_.seed, 2);
    for (std::uint64_t r = 0; r < MemberBootstrap::kResamples; ++r) {
      const std::vector<double> again = shares(p, members.times(r), of_attribution.times(r));
      for (std::size_t i = 0; i < found.size(); ++i) resampled[i].push_back(again[i]);
    }
    std::size_t at = 0;
    const auto add = [&](const std::string& name, const std::string& kind, std::size_t seen) {
      const MemberInterval interval = expanded_percentiles(resampled[at], found[at], seen, plan_.confidence);
      b.contributions.push_back({name, kind, found[at], interval});
    };
    for (std::size_t j = 0; j < joints_.size(); ++j, ++at)
      if (std::isfinite(found[at])) add(joints_[j], kClearanceKind, p.all.size());
    for (std::size_t g = 0; g < runs_.groups(); ++g, ++at)
      add(plan_.groups.names[g], kinds_[g], std::min(p.all.size(), p.change[g].size()));
    for (std::size_t i = 0; i < plan_.known.size(); ++i, ++at)
      add(plan_.known[i].name, kKnownKind, std::min(p.all.size(), p.change[runs_.groups() + i].size()));
    for (std::size_t i = 0; i < plan_.contributors.size(); ++i, ++at)
      add(plan_.contributors[i].name, kind_of(plan_.contributors[i]), p.all.size());
    if (!joints_.empty())
      add("together", "joints and scatter", attributed > 0 ? std::min(p.all.size(), attributed) : p.all.size());
  }

  const BudgetPlan& plan_;
  const BudgetRuns& runs_;
  const std::vector<Judgement>& judgements_;
  const double of_steps_;
  const BudgetAxes axes_;
  const BudgetEnsemble ensemble_;
  std::vector<std::string> joints_, kinds_;  // of the joints with clearance; of groups
  PointingHistory nominal_;
  std::vector<PointingHistory> alone_;   // per joint
  std::vector<PointingHistory> totals_;  // of the members that did not fail
  std::vector<std::uint64_t> members_;   // their numbers
  std::int64_t failed_ = 0;
  std::uint64_t attribution_ = 0;
  std::optional<GroupParts> groups_;
  double largest_ = 0.0;  // error of any member at any time
};

}  // namespace

bool Budget::met() const {
  return std::all_of(requirements.begin(), requirements.end(),
                     [](const RequirementAnswer& r) { return r.compliance.met; });
}

std::vector<Judgement> look_at_requirements(const BudgetPlan& plan, const BudgetAxes& axes, SampleStore& store) {
  std::vector<Judgement> judgements;
  for (const BudgetRequirement& r : plan.requirements)
    judgements.push_back(look(store, question_of(plan, r),
                              asked_of_members(r.interpretation, r.probability, r.confidence, plan.leave_out),
                              looked_at_members(r.interpretation, plan.leave_out), plan.members));
  const BudgetRequirement headline = plan.headline(axes);
  for (const BudgetPart& part : plan.parts)
    judgements.push_back(
        part.allocated > 0.0
            ? look(store, question_of(plan, axes, part),
                   asked_of_members(headline.interpretation, headline.probability, headline.confidence, plan.leave_out),
                   looked_at_members(headline.interpretation, plan.leave_out), plan.members)
            : Judgement{.confidence = headline.confidence, .why = ""});
  return judgements;
}

Budget budget_of(const BudgetPlan& plan, const BudgetRuns& runs, const Mechanism& mechanism, PointingQuantity quantity,
                 const SampleStore& store, const std::vector<Judgement>& judgements, double of_steps) {
  Budget budget = Maker(plan, runs, mechanism, quantity, store, judgements, of_steps).make();
  budget.spectral = spectral_levels(plan);
  if (!budget.spectral.empty()) budget.spectrum = spectrum_of(budget.shown);
  return budget;
}

}  // namespace boresight
