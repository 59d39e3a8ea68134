#include "boresight_analyses/budget/group_parts.hpp"

#include <algorithm>

namespace boresight {
namespace {

std::vector<Vec3> combined(const std::vector<std::vector<Vec3>>& columns, const std::vector<double>& values) {
  std::vector<Vec3> out(columns.front().size(), Vec3::Zero());
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (std::size_t k = 0; k < out.size(); ++k) out[k] += values[i] * columns[i][k];
  return out;
}

}  // namespace

GroupParts::GroupParts(const BudgetPlan& plan, const BudgetRuns& runs, const BudgetEnsemble& ensemble,
                       std::span<const std::uint64_t> members)
    : plan_(plan), runs_(runs), ensemble_(ensemble), members_(members) {
  for (std::size_t group = 0; group < runs.groups(); ++group) columns_.push_back(columns_of(group));
}

GroupParts::Columns GroupParts::columns_of(std::size_t group) const {
  Columns out;
  if (!plan_.is_of_errors(group)) return out;
  for (const int i : plan_.groups.members[group]) {
    const auto at = static_cast<std::size_t>(i);
    if (at >= plan_.by_parameter.size() || plan_.by_parameter[at].empty()) return {};
    out.push_back(plan_.by_parameter[at]);
  }
  return out;
}

std::vector<double> GroupParts::drawn(std::size_t group, std::uint64_t member) const {
  std::vector<double> all(plan_.inputs.size()), own;
  runs_.values(runs_.drawn(member), all);
  for (const int i : plan_.groups.members[group]) own.push_back(all[static_cast<std::size_t>(i)]);
  return own;
}

std::vector<Vec3> GroupParts::part(std::size_t group, std::uint64_t member) const {
  return combined(columns_[group], drawn(group, member));
}

bool GroupParts::hold(std::size_t group, const Columns& of_index, ErrorIndex index, const Windows& windows) const {
  constexpr double kClose = 0.01;  // of the part's root mean square
  double squares = 0.0, off = 0.0;
  for (std::uint64_t member = 0; member < runs_.attribution(); ++member) {
    const PointingHistory *with = ensemble_.mechanism(member),
                          *without = ensemble_.mechanism(member, {.held = static_cast<int>(group)});
    if (with == nullptr || without == nullptr) continue;
    const std::vector<Vec3> a = index_values(index, *with, windows), b = index_values(index, *without, windows),
                            linear = combined(of_index, drawn(group, member));
    if (linear.size() != a.size()) return false;
    for (std::size_t k = 0; k < a.size(); ++k) {
      squares += (a[k] - b[k]).squaredNorm();
      off += (a[k] - b[k] - linear[k]).squaredNorm();
    }
  }
  return squares > 0.0 && off <= kClose * kClose * squares;
}

bool GroupParts::by_columns(std::size_t group, ErrorIndex index, const Windows& windows) const {
  Columns own = columns_[group];
  for (std::vector<Vec3>& column : own) column = index_values(index, {plan_.sampling, column}, windows);
  return !own.empty() && hold(group, own, index, windows);
}

GroupSums GroupParts::sums(std::size_t group, ErrorIndex index, const Windows& windows) const {
  GroupSums s;
  s.adds_up = plan_.is_of_errors(group);
  Columns own = columns_[group];
  for (std::vector<Vec3>& column : own) column = index_values(index, {plan_.sampling, column}, windows);
  if (!own.empty() && hold(group, own, index, windows)) {
    s.of_all = true;
    for (const std::uint64_t member : members_) s.drawn.push_back(sums_of(combined(own, drawn(group, member))));
    return s;
  }
  for (std::uint64_t member = 0; member < runs_.attribution(); ++member) {
    const PointingHistory *with = ensemble_.mechanism(member),
                          *without = ensemble_.mechanism(member, {.held = static_cast<int>(group)});
    if (with == nullptr || without == nullptr) continue;
    std::vector<Vec3> a = index_values(index, *with, windows);
    const std::vector<Vec3> b = index_values(index, *without, windows);
    if (s.adds_up)
      for (std::size_t k = 0; k < a.size(); ++k) a[k] -= b[k];
    s.drawn.push_back(sums_of(a));
    if (!s.adds_up) s.held.push_back(sums_of(b));
  }
  s.of_all = runs_.attribution() == plan_.members;
  return s;
}

}  // namespace boresight
