// Allocation: the cheapest fits or tolerances, of joints and of standing errors, with which P(index <= limit) >= p is shown with the stated
// confidence.
//
// The search judges sets of fits by samples of the gaps on the linear deviation (linear_deviation.hpp). What
// that leaves out, impacts above all, is made good by a working limit: a few samples on the rung that
// confirms say by which factor its index differs on the very same gaps, and the search goes on with the limit
// divided by it (space mapping: Bandler et al. 1994, IEEE Trans. MTT 42(12)). The winner is then confirmed by
// fresh samples on that rung (confirmation.hpp); where these disagree the factor is corrected by them, the search
// goes on from there, and what it finds is confirmed by samples that are fresh again. A set that they refuted is not asked again.
//
// Before nothing is said to do, the tightest gaps are tried on that rung, and where gaps work against each other
// also the set that the search's samples find to point best.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "boresight_analyses/allocation/allocation_plan.hpp"
#include "boresight_analyses/allocation/confirmation.hpp"
#include "boresight_analyses/allocation/linear_deviation.hpp"
#include "boresight_analyses/optimise/design_evaluator.hpp"

namespace boresight {

// A linear deviation that is off by more than this against its own rung proves nothing of sets that were not confirmed.
inline constexpr double kMostMisfit = 0.02;

// By this much a limit is tightened to see what its last micrometre, or microradian, costs [m, rad].
inline constexpr double kLastMicro = 1e-6;

// One set of fits or tolerances, and what it does.
struct Allocation {
  std::string judged_by;  // "samples", "worst case", "root-sum-square"
  bool feasible = false;
  bool proven = false;      // nothing cheaper meets the same requirement by the samples of the search, with that room
  bool finished = false;    // the search ended by itself: proven, or (continuous) the descent came to rest
  std::vector<int> choice;  // of options; empty where all entries have cost curves
  std::vector<double> tolerance;  // [SI] of the entries with cost curves; empty where none has
  double price = 0.0;
  // Nothing costs less and meets the requirement by the samples of the search, with the room that a confirmation of so many samples needs; 0: not
  // known. More samples to confirm by (`confirm`) leave room for cheaper sets.
  double bound = 0.0;
  double reached = 0.0;       // the least limit that it keeps with the room a confirmation needs, on the
                              // confirming rung's scale
  double share_within = 0.0;  // of the samples, likewise
  bool meets = false;         // the requirement, by the samples of the search, without that room
  std::int64_t nodes = 0;     // of the search
  std::string why;
};

struct AllocationShare {
  std::string joint, option;  // option: the fit's name, or the tolerance in words
  double price = 0.0, cost_share = 0.0, error_share = 0.0;
  double next_saving = 0.0;  // what the next wider option alone would save; 0 where there is none
};

struct CostPoint {
  double limit = 0.0, price = 0.0;
  bool feasible = false;
};

struct AllocationResult {
  bool feasible = false;         // a set meets the requirement, confirmed
  std::size_t confirmed_by = 0;  // which of the confirmations is of the chosen set
  bool interrupted = false;
  bool converged = false;       // the search ended by itself, and what it found is confirmed
  double misfit = 0.0;          // of the linear deviation against its own rung, relative
  double factor = 1.0;          // at the end
  double best_reachable = 0.0;  // where not feasible: the least limit that the sets tried last have shown
  Allocation chosen, worst_case, root_sum_square;
  std::vector<AllocationShare> shares;
  std::vector<CostPoint> front;  // ascending limit
  double last_micrometre = 0.0;  // what keeping the limit 1 micrometre (or microradian) tighter costs; NaN if it cannot
  std::vector<AllocationConfirmation> confirmations;  // one per round
  std::int64_t evaluations = 0, reused = 0;           // sets of gaps on the confirming rung
  double search_seconds = 0.0;
};

struct AllocationOptions {
  double accuracy = 0.05;
  std::function<bool()> interrupted = {};
  std::function<void(const std::string& stage, double share)> progress = {};
};

// `confirm`: see ConfirmingModel. Throws what it throws.
AllocationResult run_allocation(const AllocationPlan& plan, const LinearDeviation& deviation, double misfit,
                                const ConfirmingModel& confirm, const std::string& rung,
                                const AllocationOptions& options);

}  // namespace boresight
