// What a group of scattered parameters does to an index: of groups of standing errors, whose parts add up, in every member by the errors'
// columns of influence; of others, and where columns do not tell what the runs do, in the members that are run without the group too.
#pragma once

#include <span>
#include <vector>

#include "boresight_analyses/budget/ensemble.hpp"
#include "boresight_analyses/budget/member_moments.hpp"

namespace boresight {

// Of the members that did not fail.
struct GroupSums {
  bool adds_up = false;  // then `drawn` are those of the group's part, and there is nothing held
  bool of_all = false;   // members; else those of the attribution
  std::vector<MemberSums> drawn, held;
};

class GroupParts {
 public:
  // members: those that did not fail.
  GroupParts(const BudgetPlan& plan, const BudgetRuns& runs, const BudgetEnsemble& ensemble,
             std::span<const std::uint64_t> members);

  GroupSums sums(std::size_t group, ErrorIndex index, const Windows& windows) const;
  // Whether the columns tell the group's part of this index in the members that are run without the group.
  bool by_columns(std::size_t group, ErrorIndex index, const Windows& windows) const;
  // By the columns, over time.
  std::vector<Vec3> part(std::size_t group, std::uint64_t member) const;

 private:
  using Columns = std::vector<std::vector<Vec3>>;  // of the group's parameters
  Columns columns_of(std::size_t group) const;
  std::vector<double> drawn(std::size_t group, std::uint64_t member) const;
  bool hold(std::size_t group, const Columns& of_index, ErrorIndex index, const Windows& windows) const;

  const BudgetPlan& plan_;
  const BudgetRuns& runs_;
  const BudgetEnsemble& ensemble_;
  std::span<const std::uint64_t> members_;
  std::vector<Columns> columns_;  // of each group, over time; empty where they do not tell its part
};

}  // namespace boresight
