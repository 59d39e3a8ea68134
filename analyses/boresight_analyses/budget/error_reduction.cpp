#include "boresight_analyses/budget/error_reduction.hpp"

#include <algorithm>
#include <functional>

namespace boresight {
namespace {

using Sizes = std::vector<std::vector<double>>;

class Reductions {
 public:
  Reductions(const BudgetPlan& plan, const ReductionParts& parts) : plan_(plan), parts_(parts) {
    for (const PointingHistory& total : parts.totals) before_.push_back(sizes(total));
  }

  std::vector<ErrorReduction> all() {
    const EnsembleInTime now(before_);
    for (std::size_t j = 0; j < parts_.joints.size(); ++j)
      run_again(parts_.joints[j], "half the clearance", {.halved = static_cast<int>(j)});
    for (std::size_t g = 0; g < parts_.runs.groups(); ++g) {
      const char* action = plan_.is_of_errors(g) ? "as drawn" : "no scatter";
      if (parts_.groups.by_columns(g, parts_.headline.index, plan_.windows))
        take_off(now, plan_.groups.names[g], action,
                 [&](std::uint64_t member) { return parts_.groups.part(g, member); });
      else
        run_again(plan_.groups.names[g], action, {.held = static_cast<int>(g)});
    }
    for (const KnownError& known : plan_.known)
      take_off(now, known.name, "as drawn", [&](std::uint64_t) { return known.history.error; });
    for (std::size_t i = 0; i < plan_.contributors.size(); ++i)
      take_off(now, plan_.contributors[i].name, "half of it", [&](std::uint64_t member) {
        std::vector<Vec3> half = parts_.ensemble.external(member, i).error;
        for (Vec3& e : half) e *= 0.5;
        return half;
      });
    std::stable_sort(out_.begin(), out_.end(),
                     [](const ErrorReduction& x, const ErrorReduction& y) { return x.gain() > y.gain(); });
    return std::move(out_);
  }

 private:
  std::vector<double> sizes(const PointingHistory& history) const {
    return sizes_of(index_values(parts_.headline.index, history, plan_.windows),
                    {parts_.headline.axis, parts_.axes.count()});
  }

  // Of every member.
  void take_off(const EnsembleInTime& now, const std::string& name, const char* action,
                const std::function<std::vector<Vec3>(std::uint64_t)>& part_of) {
    Sizes after;
    for (std::size_t m = 0; m < parts_.totals.size(); ++m) {
      PointingHistory left = parts_.totals[m];
      const std::vector<Vec3> part = part_of(parts_.members[m]);
      for (std::size_t k = 0; k < std::min(part.size(), left.error.size()); ++k) left.error[k] -= part[k];
      after.push_back(sizes(left));
    }
    add(name, action, now, EnsembleInTime(std::move(after)));
  }

  // Of the members that are run again.
  void run_again(const std::string& name, const char* action, const MemberVariant& variant) {
    Sizes before, after;
    for (std::size_t m = 0; m < parts_.members.size() && parts_.members[m] < parts_.again; ++m) {
      const PointingHistory changed = parts_.ensemble.total(parts_.members[m], variant);
      if (changed.error.empty()) continue;
      before.push_back(before_[m]);
      after.push_back(sizes(changed));
    }
    if (!before.empty()) add(name, action, EnsembleInTime(std::move(before)), EnsembleInTime(std::move(after)));
  }

  void add(const std::string& name, const char* action, const EnsembleInTime& now, const EnsembleInTime& then) {
    const BudgetRequirement& h = parts_.headline;
    const auto value = [&](const EnsembleInTime& e) {
      return e.level(h.interpretation, h.probability, plan_.confidence, plan_.leave_out).value;
    };
    ErrorReduction r{.name = name,
                     .action = action,
                     .before = value(now),
                     .after = value(then),
                     .members = static_cast<std::uint64_t>(now.members())};
    // The same members now and then: what they have in common falls out.
    const MemberBootstrap members(r.members, plan_.seed, 3);
    std::vector<double> gains;
    for (std::uint64_t k = 0; k < MemberBootstrap::kResamples; ++k) {
      const std::vector<std::uint32_t> times = members.times(k);
      gains.push_back(now.resampled_level(h.interpretation, h.probability, plan_.leave_out, times) -
                      then.resampled_level(h.interpretation, h.probability, plan_.leave_out, times));
    }
    r.interval = expanded_percentiles(std::move(gains), r.gain(), now.members(), plan_.confidence);
    const AskedShare asked = asked_of_members(h.interpretation, h.probability, plan_.confidence, plan_.leave_out);
    const bool worst_seen = h.interpretation == Interpretation::temporal && plan_.leave_out == 0.0;
    if (worst_seen || now.members() < fewest_samples(asked, {.confidence = plan_.confidence, .why = ""}))
      r.interval.high = MemberInterval{}.high;
    out_.push_back(std::move(r));
  }

  const BudgetPlan& plan_;
  const ReductionParts& parts_;
  Sizes before_;
  std::vector<ErrorReduction> out_;
};

}  // namespace

std::vector<ErrorReduction> error_reductions(const BudgetPlan& plan, const ReductionParts& parts) {
  return Reductions(plan, parts).all();
}

}  // namespace boresight
