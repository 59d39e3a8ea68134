// What a method of the sensitivity verb found, as the verb tells it: on the terminal, in the summary, as a table, in the report. One
// file a method: sobol_result.cpp, screening_result.cpp, shapley_result.cpp.
#pragma once

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "boresight_analyses/sensitivity/sensitivity.hpp"
#include "boresight_analyses/study/study.hpp"
#include "report/document.hpp"
#include "results/summary.hpp"

namespace boresight::app {

class MethodResult {
 public:
  virtual ~MethodResult() = default;
  virtual RowCounts counts() const = 0;
  // Which parameter matters most, without a full stop; for the terminal and the report's head.
  virtual std::string sentence() const = 0;
  virtual std::vector<report::Fact> facts() const = 0;
  virtual report::Section section() const = 0;
  virtual std::vector<std::string> warnings() const = 0;
  virtual void add_to(Json& summary) const = 0;
  virtual std::string table_name() const = 0;
  virtual void write_table(std::ostream& out) const = 0;
  virtual void print(const std::string& rung) const = 0;
};

// Of the plan's method, from a store that holds all runs; study and plan must outlive it. None: too many runs failed.
std::unique_ptr<MethodResult> method_result(const Study& study, const SensitivityPlan& plan, const SampleStore& store);
std::unique_ptr<MethodResult> sobol_result(const Study& study, const SensitivityPlan& plan, const SampleStore& store);
std::unique_ptr<MethodResult> screening_result(const Study& study, const SensitivityPlan& plan,
                                               const SampleStore& store);
std::unique_ptr<MethodResult> shapley_result(const Study& study, const SensitivityPlan& plan, const SampleStore& store);

// A share of the variance as terminal, verdict and tile show it, "1.043"; what rounds to nothing has no sign.
std::string share_text(double share);

// Names of the parameters of group g.
Json parameters_of(const SensitivityPlan& plan, std::size_t g);

}  // namespace boresight::app
