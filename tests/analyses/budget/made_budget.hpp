// Budgets of standing errors, made from the text of a study: a mirror on one driven axis that turns at a constant rate, whose
// boresight is off by what its drive is off by.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "boresight/io/mechanism_file.hpp"
#include "boresight_analyses/budget/budget.hpp"
#include "boresight_analyses/budget/follow_errors.hpp"

namespace boresight {

inline constexpr const char* kMirror = R"toml(
format = 1
gravity = ["0 m/s^2", "0 m/s^2", "0 m/s^2"]
[[body]]
name = "mirror"
mass = "1 kg"
center_of_mass = ["0 mm", "0 mm", "0 mm"]
inertia = ["0.01 kg m^2", "0.01 kg m^2", "0.01 kg m^2"]
boresight = [0, 0, 1]
[[joint]]
name = "Y"
type = "revolute"
connects = ["ground", "mirror"]
point = ["0 mm", "0 mm", "0 mm"]
axis = [0, 1, 0]
driven = true
[[error]]
name = "offset"
drive = "Y"
[[error]]
name = "ripple"
drive = "Y"
law = "sin(10*pi*q)"
[[error]]
name = "seat"
joint = "Y"
body = "ground"
translation = [1, 0, 0]
[motion]
duration = "1 s"
drives = { Y = "t" }
)toml";

// A budget from the text of a study's tables, each run made here.
struct MadeBudget {
  BudgetPlan plan;
  Budget budget;
  std::vector<std::string> untold;
};

inline MadeBudget make_budget(const std::shared_ptr<const Mechanism>& mechanism, const std::string& tables,
                              const std::string& quantity = "boresight_error", const std::string& rung = "multibody") {
  Document document = Document::from_text(tables, "study.toml");
  Cursor root(document);
  Study of;
  of.index.quantity = quantity;
  MadeBudget made{
      .plan = read_budget_plan(root, of, mechanism->description(), mechanism->duration(), [](const Setting&) {}),
      .budget = {},
      .untold = {}};
  made.untold = follow_errors(made.plan, *mechanism, of.index.kind());
  const BudgetRuns runs(made.plan, *mechanism);
  const BudgetModel model(rung, mechanism, made.plan, runs, {quantity, "max"}, {}, false);
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("boresight-budget-errors-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  {
    SampleStore store(folder / "samples.db", {{"study", "test"}}, made.plan.inputs.names());
    for (const NumberRange& range : runs.missing(store))
      for (std::uint64_t number = range.first; number < range.end; ++number) {
        SampleRecord record{.number = number, .inputs = std::vector<double>(made.plan.inputs.size()), .outcome = {}};
        runs.values(number, record.inputs);
        const Sample sample{number, record.inputs};
        model.evaluate({&sample, 1}, {&record.outcome, 1}, std::atomic<bool>{false});
        EXPECT_EQ(record.outcome.status, Outcome::Status::done) << record.outcome.message;
        store.add(record);
      }
    store.commit();
    made.budget = budget_of(made.plan, runs, *mechanism, of.index.kind(), store);
  }
  std::filesystem::remove_all(folder);
  return made;
}

// Of all axes together, over members and time.
inline double mixed_level(const Budget& b, ErrorIndex index, std::size_t total = 2) {
  for (const BudgetLevel& l : b.levels)
    if (l.index == index && l.interpretation == Interpretation::mixed && l.axis == total) return l.level.value;
  return -1.0;
}

inline const ClassicalTable& table_of(const Budget& b, ErrorIndex index, Interpretation interpretation) {
  for (const ClassicalTable& t : b.tables)
    if (t.index == index && t.interpretation == interpretation) return t;
  throw std::out_of_range("no such table");
}

}  // namespace boresight
