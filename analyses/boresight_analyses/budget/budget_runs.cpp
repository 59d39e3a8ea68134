#include "boresight_analyses/budget/budget_runs.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/mechanism/built_mechanism.hpp"
#include "boresight_analyses/budget/course_filter.hpp"
#include "boresight_analyses/study/rung_sample_model.hpp"

namespace boresight {

namespace {

bool has_median_errors(const BudgetPlan& plan, const Mechanism& mechanism) {
  std::vector<double> medians;
  for (const RandomParameter& random : plan.inputs.parameters) medians.push_back(random.distribution->quantile(0.5));
  return has_errors(plan.inputs.parameters_with(mechanism, medians));
}

}  // namespace

BudgetRuns::BudgetRuns(const BudgetPlan& plan, const Mechanism& mechanism)
    : plan_(plan),
      groups_(plan.groups.members.size()),
      joints_(static_cast<std::size_t>(mechanism.clearances())),
      alone_(joints_ > 1 || (joints_ == 1 && has_median_errors(plan, mechanism))),
      rows_(plan.inputs.size() > 0 ? plan.members : 1),
      attribution_(std::min(rows_, plan.attribution)) {
  if (plan.inputs.size() > 0)
    design_ = std::make_unique<const SamplingDesign>(plan.design(), static_cast<int>(plan.inputs.size()));
}

std::uint64_t BudgetRuns::count() const { return first() + attribution_ * slots() + (rows_ - attribution_); }

std::vector<NumberRange> BudgetRuns::missing(const SampleStore& store) const {
  std::vector<NumberRange> needed = {{0, drawn(attribution_)}};
  for (std::uint64_t member = attribution_; member < rows_; ++member)
    needed.push_back({drawn(member), drawn(member) + 1});
  std::vector<NumberRange> out;
  std::size_t at = 0;
  for (const NumberRange& gap : store.missing(needed.back().end)) {
    while (at < needed.size() && needed[at].end <= gap.first) ++at;
    for (std::size_t k = at; k < needed.size() && needed[k].first < gap.end; ++k)
      out.push_back({std::max(gap.first, needed[k].first), std::min(gap.end, needed[k].end)});
  }
  return out;
}

BudgetRuns::Variant BudgetRuns::variant(std::uint64_t number) const {
  Variant v;
  if (number < first()) {
    v.nominal = true;
    v.alone = number == 0 ? -1 : static_cast<int>(number) - 1;
    return v;
  }
  v.member = (number - first()) / slots();
  const auto slot = static_cast<int>((number - first()) % slots());
  const auto groups = static_cast<int>(groups_);
  if (slot > groups)
    v.halved = slot - 1 - groups;
  else if (slot > 0)
    v.group = slot - 1;
  return v;
}

void BudgetRuns::values(std::uint64_t number, std::span<double> values) const {
  if (!design_) return;
  const Variant v = variant(number);
  constexpr double kMedian = 0.5;
  if (v.nominal) {
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = plan_.inputs.parameters[i].distribution->quantile(kMedian);
    return;
  }
  design_->point(v.member, values);
  plan_.inputs.values(values);
  if (v.group >= 0)
    for (const int i : plan_.groups.members[static_cast<std::size_t>(v.group)])
      values[static_cast<std::size_t>(i)] =
          plan_.is_of_errors(static_cast<std::size_t>(v.group))
              ? 0.0
              : plan_.inputs.parameters[static_cast<std::size_t>(i)].distribution->quantile(kMedian);
}

BudgetModel::BudgetModel(const std::string& rung, std::shared_ptr<const Mechanism> mechanism, const BudgetPlan& plan,
                         const BudgetRuns& runs, IndexChoice index, const RunOptions& options, bool scene_varies)
    : plan_(plan), runs_(runs), mechanism_(mechanism) {
  const auto model = [&](const std::shared_ptr<const Mechanism>& of,
                         const RungSampleModel::ParametersOf& parameters_of) {
    return std::make_unique<RungSampleModel>(
        rung, of, parameters_of, index, options, scene_varies,
        KeptOfRun{plan.sampling, [of, &plan, kind = index.kind()](const RunResult& run) {
                    return history_on_grid(run, kind, of->pointing(), plan);
                  }});
  };
  const auto drawn = [mechanism, &plan](std::span<const double> values) {
    return plan.inputs.parameters_with(*mechanism, values);
  };
  models_.push_back(model(mechanism, drawn));
  const std::size_t joints = runs.joints();
  for (std::size_t j = 0; runs.has_alone() && j < joints; ++j) {
    MechanismDescription alone = mechanism->description();
    alone.clearances = {alone.clearances[j]};
    models_.push_back(
        model(std::make_shared<const Mechanism>(std::move(alone)), [drawn, j](std::span<const double> values) {
          Parameters p = drawn(values);
          p.clearance = {p.clearance[j]};
          std::fill(p.error.begin(), p.error.end(), 0.0);
          return p;
        }));
  }
  for (std::size_t j = 0; j < joints; ++j)
    models_.push_back(model(mechanism, [drawn, j](std::span<const double> values) {
      Parameters p = drawn(values);
      for (const auto gap : kGaps) p.clearance[j].*gap *= 0.5;
      return p;
    }));
}

std::string BudgetModel::rung() const { return models_.front()->rung(); }
double BudgetModel::step() const { return models_.front()->step(); }
std::string BudgetModel::leaves_out() const { return models_.front()->leaves_out(); }

bool BudgetModel::deviates(const Sample& sample) const {
  return runs_.joints() > 0 || has_errors(plan_.inputs.parameters_with(*mechanism_, sample.values));
}

void BudgetModel::evaluate(std::span<const Sample> samples, std::span<Outcome> outcomes,
                           const std::atomic<bool>& stop) const {
  for (std::size_t k = 0; k < samples.size() && !stop; ++k) {
    const BudgetRuns::Variant v = runs_.variant(samples[k].number);
    const std::size_t alone = runs_.has_alone() ? runs_.joints() : 0;
    if (!deviates(samples[k])) {
      outcomes[k] = {.status = Outcome::Status::done, .value = 0.0};
      outcomes[k].history.assign(3 * (lead_of(plan_) + samples_of(plan_)), 0.0);
      continue;
    }
    std::size_t which = 0;
    if (v.alone >= 0) which = 1 + static_cast<std::size_t>(v.alone);
    if (v.halved >= 0) which = 1 + alone + static_cast<std::size_t>(v.halved);
    models_[which]->evaluate(samples.subspan(k, 1), outcomes.subspan(k, 1), stop);
  }
}

std::size_t samples_of(const BudgetPlan& plan) {
  return static_cast<std::size_t>(std::max(1.0, std::round(plan.duration / plan.sampling)));
}

std::size_t lead_of(const BudgetPlan& plan) {
  if (!plan.through) return 0;
  constexpr double kSlack = 1e-6, kMost = 1e6;  // of the sampling; samples
  return static_cast<std::size_t>(std::min({kMost, std::floor(plan.start / plan.sampling + kSlack),
                                            std::ceil(CourseFilter::settling_time(*plan.through) / plan.sampling)}));
}

std::vector<double> history_on_grid(const RunResult& run, PointingQuantity quantity, const Pointing& pointing,
                                    const BudgetPlan& plan) {
  const std::vector<PoseSample>& samples = run.boresight.samples;
  const std::size_t lead = lead_of(plan), size = lead + samples_of(plan);
  std::vector<double> out;
  out.reserve(3 * size);
  std::size_t at = 0;
  constexpr double kSlack = 1e-6;  // of the sampling: rounding of t
  const auto error = [&](std::size_t k) { return error_vector(quantity, samples[k].pose, samples[k].ideal, pointing); };
  for (std::size_t k = 0; k < size; ++k) {
    const double t = plan.start + (static_cast<double>(k) - static_cast<double>(lead)) * plan.sampling;
    while (at + 2 < samples.size() && run.time[at + 1] <= t + kSlack * plan.sampling) ++at;
    const std::size_t next = std::min(at + 1, samples.size() - 1);
    const double span = run.time[next] - run.time[at];
    const double share = span > 0.0 ? std::clamp((t - run.time[at]) / span, 0.0, 1.0) : 0.0;
    const Vec3 before = error(at);
    const Vec3 e = share > 0.0 ? Vec3(before + share * (error(next) - before)) : before;
    out.insert(out.end(), e.data(), e.data() + 3);
  }
  return out;
}

namespace {

PointingHistory history_with_lead(const SampleStore& store, std::uint64_t number, const BudgetPlan& plan) {
  const std::vector<double> doubles = store.history(number);
  PointingHistory history{plan.sampling, {}};
  for (std::size_t k = 0; k + 2 < doubles.size(); k += 3)
    history.error.emplace_back(doubles[k], doubles[k + 1], doubles[k + 2]);
  return history;
}

void drop_lead(const BudgetPlan& plan, std::vector<Vec3>& error) {
  const std::size_t lead = std::min(error.size(), lead_of(plan));
  error.erase(error.begin(), error.begin() + static_cast<std::ptrdiff_t>(lead));
}

}  // namespace

PointingHistory sampled_history(const SampleStore& store, std::uint64_t number, const BudgetPlan& plan) {
  PointingHistory history = history_with_lead(store, number, plan);
  drop_lead(plan, history.error);
  return history;
}

PointingHistory stored_history(const SampleStore& store, std::uint64_t number, const BudgetPlan& plan) {
  PointingHistory history = history_with_lead(store, number, plan);
  pass_through(plan, history.error);
  return history;
}

void pass_through(const BudgetPlan& plan, std::vector<Vec3>& error) {
  if (!plan.through || error.empty()) return;
  const CourseFilter filter(*plan.through, plan.sampling);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> course;
    for (const Vec3& e : error) course.push_back(e[axis]);
    const std::vector<double> seen = filter.through(course);
    for (std::size_t k = 0; k < error.size(); ++k) error[k][axis] = seen[k];
  }
  drop_lead(plan, error);
}

}  // namespace boresight
