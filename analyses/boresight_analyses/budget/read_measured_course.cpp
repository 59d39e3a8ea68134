#include "boresight_analyses/budget/read_measured_course.hpp"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/budget/budget_runs.hpp"
#include "boresight_analyses/budget/noise_keys.hpp"
#include "boresight_analyses/budget/read_noise.hpp"

namespace boresight {
std::shared_ptr<const MeasuredCourse> read_measured_course(Cursor& contributor, const BudgetPlan& plan,
                                                           const std::vector<std::size_t>& axes,
                                                           const std::string& si_unit) {
  using Ends = MeasuredCourse::Ends;
  using Begin = MeasuredCourse::Begin;
  Cursor table = contributor.table("measured");
  table.only(measured_keys());
  const UnitOfInput unit(contributor, table, si_unit, false);
  MeasuredCourse::Record record;
  record.time = read_column(table, "time", table.text("time"));
  table.require(record.time.size() >= 2, "file", "at least two rows");
  for (std::size_t k = 1; k < record.time.size(); ++k)
    if (!(record.time[k] > record.time[k - 1]))
      table.fail_found("time", std::to_string(record.time[k]) + " in row " + std::to_string(k + 1),
                       "times that rise from row to row");
  double scale = 1.0;
  try {
    scale = scale_of_unit(table.text("unit"), unit.si());
  } catch (const ValueFault& fault) {
    throw InputError(table.origin("unit"), table.path("unit"), fault.found, fault.expected, fault.nearest);
  }
  const std::vector<std::string> columns = table.texts("columns");
  if (columns.size() != axes.size())
    table.fail_found("columns", std::to_string(columns.size()) + " columns",
                     std::to_string(axes.size()) + ", one for each axis that the contributor acts on");
  for (std::size_t k = 0; k < axes.size(); ++k) {
    std::vector<double>& values = record.value[axes[k]];
    values = read_column(table, "columns", columns[k]);
    if (values.size() != record.time.size())
      table.fail_found("columns", std::to_string(values.size()) + " values of " + columns[k],
                       std::to_string(record.time.size()) + ", as many as times");
    for (double& v : values) v *= scale;
  }
  const std::string ends = table.choice("ends");
  for (const Ends one : {Ends::refused, Ends::held, Ends::zero, Ends::repeated})
    if (ends == to_string(one)) record.ends = one;
  record.begin = table.choice("begin") == to_string(Begin::anywhere) ? Begin::anywhere : Begin::with_the_motion;
  const std::vector<TransferFunction> through = read_through(contributor);
  std::optional<TransferFunction> all;
  if (!through.empty()) all = in_a_row(through);
  const double first = record.time.front(), last = record.time.back();
  table.finish();
  try {
    return std::make_shared<const MeasuredCourse>(std::move(record), all, plan.sampling, samples_of(plan), plan.start);
  } catch (const std::invalid_argument&) {
    char found[120], expected[160];
    std::snprintf(found, sizeof found, "a record from %g to %g s, whose ends are refused", first, last);
    std::snprintf(expected, sizeof expected, "a record of the whole motion from %g to %g s, or another word for ends",
                  plan.start, plan.start + plan.duration);
    table.fail_found("ends", found, expected);
  }
}

}  // namespace boresight
