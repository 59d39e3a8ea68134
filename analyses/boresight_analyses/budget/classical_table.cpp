#include "boresight_analyses/budget/classical_table.hpp"

#include <algorithm>
#include <cmath>

#include "boresight_analyses/budget/line_kinds.hpp"

namespace boresight {
namespace {

using Times = std::span<const std::uint32_t>;

ClassicalLine line_of(const std::string& name, const std::string& kind, std::size_t axes,
                      const std::vector<Moments>& moments, const Mat3& covariance) {
  ClassicalLine line{name, kind, "", moments, {}, {}};
  Vec3 deviations = Vec3::Zero();
  for (std::size_t a = 0; a < axes; ++a) deviations[static_cast<Eigen::Index>(a)] = moments[a].sd;
  line.factor = factor_with(covariance, deviations);
  return line;
}

ClassicalLine line_of(const std::string& name, const std::string& kind, std::size_t axes,
                      std::span<const MemberSums> sums, Interpretation interpretation, Times times = {}) {
  std::vector<Moments> moments;
  for (std::size_t a = 0; a < axes; ++a)
    moments.push_back(moments_of(sums, static_cast<Eigen::Index>(a), interpretation, times));
  return line_of(name, kind, axes, moments, covariance_of(sums, interpretation, times));
}

// Of what does not add up: what mean and variance lose where the group is held.
ClassicalLine line_of(const std::string& name, const std::string& kind, std::size_t axes, const GroupSums& group,
                      Interpretation interpretation, Times times = {}) {
  if (group.adds_up) return line_of(name, kind, axes, group.drawn, interpretation, times);
  std::vector<Moments> moments;
  for (std::size_t a = 0; a < axes; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    const Moments with = moments_of(group.drawn, axis, interpretation, times),
                  without = moments_of(group.held, axis, interpretation, times);
    moments.push_back(
        {with.mean - without.mean, std::sqrt(std::max(0.0, with.sd * with.sd - without.sd * without.sd))});
  }
  return line_of(name, kind, axes, moments,
                 covariance_of(group.drawn, interpretation, times) - covariance_of(group.held, interpretation, times));
}

}  // namespace

MemberInterval ClassicalTable::rule_interval(std::size_t axis, double probability, double confidence) const {
  const double value = by_rule(axis, probability);
  if (resampled.empty()) return {value, value};
  std::vector<double> again;
  for (const ClassicalTotal& of : resampled) again.push_back(level_of(of, axis, probability));
  MemberInterval interval = expanded_percentiles(std::move(again), value, members, confidence);
  // The worst of some members says nothing of how bad the worst of all is.
  if (interpretation == Interpretation::temporal) interval.high = MemberInterval{}.high;
  return interval;
}

std::vector<ClassicalTable> classical_tables(const BudgetPlan& plan, const ClassicalParts& parts, ErrorIndex index,
                                             const Windows& windows) {
  const std::size_t axes = parts.axes.count();
  std::vector<std::vector<MemberSums>> alone, known;
  for (const PointingHistory& history : parts.alone) {
    alone.emplace_back();
    if (!history.error.empty()) alone.back().push_back(sums_of(index_values(index, history, windows)));
  }
  for (const KnownError& error : plan.known) known.push_back({sums_of(index_values(index, error.history, windows))});
  std::vector<GroupSums> groups;
  for (std::size_t g = 0; g < parts.kinds.size(); ++g) groups.push_back(parts.groups.sums(g, index, windows));
  const std::vector<Draws> draws = draws_of(plan.contributors, plan.correlations);

  std::vector<ClassicalTable> tables;
  for (const Interpretation interpretation : kInterpretations) {
    ClassicalTable t{.index = index, .interpretation = interpretation, .lines = {}, .total = {}};
    for (std::size_t j = 0; j < parts.joints.size(); ++j)
      t.lines.push_back(line_of(parts.joints[j], kClearanceKind, axes, alone[j], interpretation));
    for (std::size_t g = 0; g < groups.size(); ++g) {
      t.lines.push_back(line_of(plan.groups.names[g], parts.kinds[g], axes, groups[g], interpretation));
      t.lines.back().of_all_members = groups[g].of_all;
    }
    for (std::size_t i = 0; i < known.size(); ++i)
      t.lines.push_back(line_of(plan.known[i].name, kKnownKind, axes, known[i], interpretation));
    for (std::size_t i = 0; i < plan.contributors.size(); ++i) {
      const Contributor& c = plan.contributors[i];
      const AxesMoments m = axes_moments(c, index, interpretation, windows, plan.duration);
      t.lines.push_back({c.name, kind_of(c), c.group, {}, m.factor, draws[i], m.either_sign});
      for (std::size_t a = 0; a < axes; ++a) {
        const auto axis = static_cast<Eigen::Index>(a);
        t.lines.back().axes.push_back({m.mean[axis], m.factor.row(axis).norm()});
      }
    }
    const auto total = [&](std::span<const ClassicalLine> lines) {
      ClassicalTotal of = total_of(lines);
      if (of.axes.empty()) of.axes.resize(axes);
      return of;
    };
    t.total = total(t.lines);
    for (const GroupSums& group : groups)
      if (!group.of_all) t.members = std::max(t.members, group.drawn.size());
    const MemberBootstrap members(std::max<std::size_t>(1, t.members), plan.seed, 4);
    std::vector<ClassicalLine> lines = t.lines;
    for (std::uint64_t r = 0; t.members > 0 && r < MemberBootstrap::kResamples; ++r) {
      const std::vector<std::uint32_t> times = members.times(r);
      for (std::size_t g = 0; g < groups.size(); ++g) {
        if (groups[g].of_all) continue;
        const Times own(times.data(), groups[g].drawn.size());
        lines[parts.joints.size() + g] =
            line_of(plan.groups.names[g], parts.kinds[g], axes, groups[g], interpretation, own);
      }
      t.resampled.push_back(total(lines));
    }
    tables.push_back(std::move(t));
  }
  return tables;
}

}  // namespace boresight
