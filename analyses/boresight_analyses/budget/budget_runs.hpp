// The runs that a budget is made of, each with a number, so that they are kept in a store and gone on with.
//
//   0                        the mechanism with every scattered parameter at its median
//   1 .. joints              the same with one clearance alone, the other joints ideal and without standing errors (only where
//                            there are several joints, or errors)
//   then per member          as it is drawn; per group of parameters, the same with the group at its medians (a
//                            group of standing errors: at zero, as drawn); per
//                            clearance joint, the same with the clearance halved, radial and axial
//
// All members are run as drawn; the first `attribution` of them in all variants. Where nothing scatters the one member
// is the mechanism itself.
#pragma once

#include <memory>

#include "boresight/rungs/rung.hpp"
#include "boresight_analyses/budget/budget_plan.hpp"
#include "boresight_analyses/runs/sample_store.hpp"
#include "boresight_analyses/study/sample_model.hpp"

namespace boresight {

class BudgetRuns {
 public:
  BudgetRuns(const BudgetPlan& plan, const Mechanism& mechanism);

  std::uint64_t rows() const { return rows_; }                // members as drawn
  std::uint64_t attribution() const { return attribution_; }  // members in all variants
  std::size_t groups() const { return groups_; }
  std::size_t joints() const { return joints_; }

  std::uint64_t nominal() const { return 0; }
  bool has_alone() const { return alone_; }  // else the nominal motion is that of the one joint alone
  std::uint64_t alone(std::size_t joint) const { return alone_ ? 1 + joint : 0; }
  std::uint64_t drawn(std::uint64_t member) const { return first() + member * slots(); }
  std::uint64_t held(std::uint64_t member, std::size_t group) const { return drawn(member) + 1 + group; }
  std::uint64_t halved(std::uint64_t member, std::size_t joint) const { return drawn(member) + 1 + groups_ + joint; }

  std::uint64_t count() const;  // of all runs needed
  std::vector<NumberRange> missing(const SampleStore& store) const;
  // The values of the scattered parameters in a run. From any thread.
  void values(std::uint64_t number, std::span<double> values) const;

  struct Variant {
    bool nominal = false;
    int alone = -1, group = -1, halved = -1;  // which one; -1: none
    std::uint64_t member = 0;
  };
  Variant variant(std::uint64_t number) const;

 private:
  std::uint64_t first() const { return 1 + (alone_ ? joints_ : 0); }
  std::uint64_t slots() const { return 1 + groups_ + joints_; }

  const BudgetPlan& plan_;
  std::size_t groups_, joints_;
  bool alone_;
  std::uint64_t rows_, attribution_;
  std::unique_ptr<const SamplingDesign> design_;  // none where nothing scatters
};

// The model of these runs: Outcome::history holds the error vector at the plan's sampling from its start on, component
// by component within a sample; the value is the quantity's maximum over every step of the run.
class BudgetModel final : public SampleModel {
 public:
  BudgetModel(const std::string& rung, std::shared_ptr<const Mechanism> mechanism, const BudgetPlan& plan,
              const BudgetRuns& runs, IndexChoice index, const RunOptions& options, bool scene_varies);

  std::string rung() const override;
  double step() const override;
  std::string leaves_out() const override;
  std::size_t batch() const override { return 1; }
  void evaluate(std::span<const Sample> samples, std::span<Outcome> outcomes,
                const std::atomic<bool>& stop) const override;

 private:
  // Not where a sample's mechanism is the drawn one and no joint has play: its history is nothing, and rungs that follow what deviates
  // refuse it.
  bool deviates(const Sample& sample) const;

  const BudgetPlan& plan_;
  const BudgetRuns& runs_;
  std::shared_ptr<const Mechanism> mechanism_;
  std::vector<std::unique_ptr<SampleModel>>
      models_;  // as it is; per joint alone (if it has such runs); per joint halved
};

// Error vectors out of a run's samples onto the grid of the plan.
// How many of them that has.
std::size_t samples_of(const BudgetPlan& plan);
// Samples before the start that a history is followed from, as far as a pointing loop that sees it takes to settle and the motion has them.
std::size_t lead_of(const BudgetPlan& plan);
// With the lead before it.
std::vector<double> history_on_grid(const RunResult& run, PointingQuantity quantity, const Pointing& pointing,
                                    const BudgetPlan& plan);
// What the store holds of a run, the mechanism's own error; empty if it failed.
PointingHistory sampled_history(const SampleStore& store, std::uint64_t number, const BudgetPlan& plan);
// The same as the pointing has it: behind BudgetPlan::through.
PointingHistory stored_history(const SampleStore& store, std::uint64_t number, const BudgetPlan& plan);
// error: with the lead; then without.
void pass_through(const BudgetPlan& plan, std::vector<Vec3>& error);

}  // namespace boresight
