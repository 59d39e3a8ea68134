#include "boresight_analyses/budget/sub_budgets.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace boresight {
namespace {

constexpr const char* kMechanism = "mechanism";

// What a part holds, with all that is within it.
struct Held {
  std::set<std::size_t> contributors;
  bool mechanism = false;
};

Held held_by(const BudgetPlan& plan, const BudgetPart& part) {
  Held held{{part.contributors.begin(), part.contributors.end()}, part.mechanism};
  for (const BudgetPart& inner : plan.parts) {
    if (inner.within != part.name) continue;
    const Held more = held_by(plan, inner);
    held.contributors.insert(more.contributors.begin(), more.contributors.end());
    held.mechanism = held.mechanism || more.mechanism;
  }
  return held;
}

// The sum of its errors in one member; without samples if the member's own run failed.
PointingHistory sum_of(const Held& held, const BudgetEnsemble& ensemble, std::uint64_t member) {
  const PointingHistory* mechanism = ensemble.mechanism(member);
  if (mechanism == nullptr) return {};
  PointingHistory sum = *mechanism;
  if (!held.mechanism) std::fill(sum.error.begin(), sum.error.end(), Vec3::Zero());
  for (const std::size_t i : held.contributors) {
    const PointingHistory added = ensemble.external(member, i);
    for (std::size_t k = 0; k < std::min(sum.error.size(), added.error.size()); ++k) sum.error[k] += added.error[k];
  }
  return sum;
}

double by_rule(const Held& held, const BudgetPlan& plan, const BudgetRequirement& headline,
               const std::vector<ClassicalLine>& lines, const BudgetAxes& axes) {
  std::vector<ClassicalLine> own;
  for (const ClassicalLine& line : lines) {
    const auto at = std::find_if(plan.contributors.begin(), plan.contributors.end(),
                                 [&](const Contributor& c) { return c.name == line.name && kind_of(c) == line.kind; });
    const bool external = at != plan.contributors.end();
    if (external ? held.contributors.contains(static_cast<std::size_t>(at - plan.contributors.begin()))
                 : held.mechanism)
      own.push_back(line);
  }
  const ClassicalTotal total = total_of(own);
  if (total.axes.empty()) return 0.0;
  return headline.axis == axes.count() ? total.radius_by_rule(headline.interpretation, headline.probability)
                                       : total.axis_level(headline.axis, headline.probability);
}

class Tree {
 public:
  Tree(const BudgetPlan& plan, const BudgetEnsemble& ensemble, double of_steps, const BudgetAxes& axes,
       const std::vector<ClassicalLine>& lines, const std::vector<Judgement>& judgements)
      : plan_(plan),
        ensemble_(ensemble),
        of_steps_(of_steps),
        axes_(axes),
        lines_(lines),
        judgements_(judgements),
        headline_(plan.headline(axes)) {}

  std::vector<SubBudget> all() {
    add("", 0);
    return std::move(out_);
  }

 private:
  void add(const std::string& within, int depth) {
    for (std::size_t p = 0; p < plan_.parts.size(); ++p) {
      if (plan_.parts[p].within != within) continue;
      out_.push_back(made(p, depth));
      add(plan_.parts[p].name, depth + 1);
    }
  }

  SubBudget made(std::size_t p, int depth) const {
    const BudgetPart& part = plan_.parts[p];
    const Held held = held_by(plan_, part);
    SubBudget b{.name = part.name,
                .within = part.within,
                .depth = depth,
                .holds = {},
                .allocated = part.allocated,
                .unit = part.unit};
    if (held.mechanism) b.holds.emplace_back(kMechanism);
    for (const std::size_t i : held.contributors) b.holds.push_back(plan_.contributors[i].name);
    const AxisOf axis(headline_.axis, axes_.count());
    std::vector<std::vector<double>> sizes;
    std::vector<double> missed;
    std::int64_t failed = 0;
    for (std::uint64_t member = 0; member < plan_.members; ++member) {
      const PointingHistory sum = sum_of(held, ensemble_, member);
      if (sum.error.empty()) {
        ++failed;
        continue;
      }
      sizes.push_back(sizes_of(index_values(headline_.index, sum, plan_.windows), axis));
      if (!held.mechanism) continue;
      const double error = of_steps_ + ensemble_.model_error(member);
      b.model_error = std::max(b.model_error, error);
      missed.push_back(missed_of(ensemble_, member, error, headline_.index, plan_.windows, axis));
    }
    const EnsembleInTime in_time(std::move(sizes), failed);
    b.judgement = judgements_.empty() ? Judgement{.confidence = headline_.confidence, .why = ""} : judgements_[p];
    b.level = in_time.level(headline_.interpretation, headline_.probability, plan_.confidence, plan_.leave_out);
    b.by_rule = by_rule(held, plan_, headline_, lines_, axes_);
    if (part.allocated > 0.0) {
      const auto judged = [&](const EnsembleInTime& of) {
        return of.compliance(headline_.interpretation, part.allocated, headline_.probability, b.judgement,
                             plan_.leave_out);
      };
      b.compliance = judged(in_time);
      b.kept_by_members = b.compliance.met;
      if (b.model_error > 0.0) {
        b.within_error = judged(in_time.raised(missed));
        b.compliance.met = b.kept_by_members && b.within_error.met;
      }
    }
    for (const BudgetPart& inner : plan_.parts)
      if (inner.within == part.name && inner.allocated > 0.0) {
        b.parts_sum += inner.allocated;
        b.parts_root_sum_square = std::hypot(b.parts_root_sum_square, inner.allocated);
      }
    return b;
  }

  const BudgetPlan& plan_;
  const BudgetEnsemble& ensemble_;
  const double of_steps_;
  const BudgetAxes& axes_;
  const std::vector<ClassicalLine>& lines_;
  const std::vector<Judgement>& judgements_;
  const BudgetRequirement headline_;
  std::vector<SubBudget> out_;
};

}  // namespace

std::vector<SubBudget> sub_budgets(const BudgetPlan& plan, const BudgetEnsemble& ensemble, double of_steps,
                                   const BudgetAxes& axes, const std::vector<ClassicalLine>& lines,
                                   const std::vector<Judgement>& judgements) {
  return Tree(plan, ensemble, of_steps, axes, lines, judgements).all();
}

std::string question_of(const BudgetPlan& plan, const BudgetAxes& axes, const BudgetPart& part) {
  BudgetRequirement asked = plan.headline(axes);
  asked.limit = part.allocated;
  const Held held = held_by(plan, part);
  std::string text = question_of(plan, asked) + " of" + (held.mechanism ? " mechanism" : "");
  for (const std::size_t i : held.contributors) text += " " + std::to_string(i);
  return text;
}

}  // namespace boresight
