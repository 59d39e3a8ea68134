#include "boresight_analyses/budget/read_correlations.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/budget/budget_keys.hpp"

namespace boresight {
namespace {

// Draws of one sort have scores that a correlation can mix; "": of none.
std::string sort_of(const Contributor& c) {
  if (c.of_error || c.measured || c.kind == ContributorClass::periodic) return "";
  if (c.noise) return "noise by its spectrum";
  return c.kind == ContributorClass::random ? "noise of first order" : "values";
}

constexpr const char* kSorts = "biases and drifts, noises of class random, or noises by their spectra";

std::size_t read_place(Cursor& table, const BudgetPlan& plan, const std::string& name) {
  std::vector<std::string> names;
  for (const Contributor& c : plan.contributors) names.push_back(c.name);
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end())
    table.fail_found("contributors", "\"" + name + "\"", "the name of a contributor", nearest_name(name, names));
  return static_cast<std::size_t>(at - names.begin());
}

}  // namespace

void read_correlations(Cursor& budget, BudgetPlan& plan) {
  std::vector<Cursor> tables = budget.tables("correlation");
  const std::vector<std::uint64_t> streams = streams_of(plan.contributors);
  for (Cursor& table : tables) {
    table.only(budget_correlation_keys());
    const std::vector<std::string> names = table.texts("contributors");
    ContributorCorrelation c{read_place(table, plan, names[0]), read_place(table, plan, names[1]),
                             table.number("coefficient")};
    const auto both = names[0] + " and " + names[1];
    if (streams[c.first] == streams[c.second])
      table.fail_found("contributors", both + ", which vary as one",
                       "two contributors of which neither is in the other's group");
    const std::string first = sort_of(plan.contributors[c.first]), second = sort_of(plan.contributors[c.second]);
    if (first.empty() || first != second)
      table.fail_found("contributors", both, "two of one sort: " + std::string(kSorts));
    // A group is correlated as a whole.
    for (std::size_t k = 0; k < streams.size(); ++k)
      if ((streams[k] == streams[c.first] || streams[k] == streams[c.second]) && sort_of(plan.contributors[k]) != first)
        table.fail_found("contributors",
                         both + ", in a group with " + plan.contributors[k].name + ", which is of another sort",
                         "two whose groups are of one sort: " + std::string(kSorts));
    for (const ContributorCorrelation& known : plan.correlations)
      if (std::minmax(streams[known.first], streams[known.second]) == std::minmax(streams[c.first], streams[c.second]))
        table.fail_found("contributors", both + " a second time", "each pair, or pair of groups, once");
    plan.correlations.push_back(c);
    table.finish();
  }
  // All together: what a pair that comes later says may be what makes those before it possible.
  try {
    draws_of(plan.contributors, plan.correlations);
  } catch (const std::domain_error&) {
    tables.back().fail("coefficient", "coefficients that go together: their matrix has to be positive definite");
  }
}

void read_frame(Cursor& contributor, const BudgetAxes& axes, Contributor& c) {
  if (contributor.has("frame")) {
    Cursor table = contributor.table("frame");
    table.only(budget_frame_keys());
    static const char* const names[] = {"x", "y", "z"};
    std::vector<Eigen::Index> given;
    for (Eigen::Index k = 0; k < 3; ++k)
      if (table.has(names[k])) {
        c.frame.col(k) = table.direction(names[k]);
        given.push_back(k);
      }
    if (given.size() != 2) contributor.fail("frame", "two of x, y, z");
    const Eigen::Index a = given[0], b = given[1], third = 3 - a - b;
    constexpr double kLargestSkew = 1e-3;  // cosine of the angle
    if (std::abs(c.frame.col(a).dot(c.frame.col(b))) > kLargestSkew)
      contributor.fail_found("frame", "axes that are not perpendicular", "perpendicular axes");
    c.frame.col(b) = (c.frame.col(b) - c.frame.col(a).dot(c.frame.col(b)) * c.frame.col(a)).normalized();
    c.frame.col(third) = c.frame.col(a).cross(c.frame.col(b)) * (b - a == 1 ? 1.0 : -1.0);
    // Of a direction's error there is no component along it.
    if (axes.count() < 3) c.frame.row(2).setZero();
    table.finish();
  }
  if (!contributor.has("axis_correlation")) return;
  if (sort_of(c).empty())
    contributor.fail("axis_correlation", "this with draws of one sort only: " + std::string(kSorts));
  const std::vector<double> given = contributor.numbers("axis_correlation");
  const bool three = axes.count() == 3 || contributor.has("frame");
  if (given.size() != (three ? 3u : 1u))
    contributor.fail_found("axis_correlation", std::to_string(given.size()) + " coefficients",
                           three ? "three: of x with y, x with z, y with z" : "one: of x with y");
  try {
    c.axes_factor = three ? axes_of_correlation(given[0], given[1], given[2]) : axes_of_correlation(given[0], 0.0, 0.0);
  } catch (const std::domain_error&) {
    contributor.fail("axis_correlation", "coefficients that a correlation matrix can have, positive definite");
  }
}

}  // namespace boresight
