// What the samples of a study say: mean, sd and quantiles of the index with intervals, the verdict on the requirement,
// how the estimate settled, and what each number is uncertain by.
//
// Intervals belong to the design: order statistics and Clopper-Pearson for independent samples, the scatter over
// replicates for hypercubes and nets (analyses/statistics). A failed sample is a bad one.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "boresight_analyses/montecarlo/looks.hpp"
#include "boresight_analyses/montecarlo/montecarlo_plan.hpp"
#include "boresight_analyses/statistics/interval.hpp"

namespace boresight {

struct NamedEstimate {
  std::string name;           // among headlines()
  ReportedInterval interval;  // NaN where there are too few samples for it
};

struct RequirementVerdict {
  bool met = false;  // shown to be met: the lower bound of the probability reaches what is asked, of `within_error` too
  ReportedInterval probability;     // low and high are one-sided bounds, each at the requirement's confidence
  Judgement judgement = {};         // by which these bounds hold: looks.hpp
  std::int64_t fewest_samples = 0;  // of its design that could show it at all, if none is above the limit
  // By how much rung and steps may be off, relative, of the samples' mean where each has its own (0 where not known); and the share of samples
  // that stay below the limit even if each of them is off by as much.
  double model_error = 0.0;
  std::optional<ReportedInterval> within_error = {};
  bool met_by_samples = false;  // would be met, were the model without fault
};

// A standard of what a number is wrong by, in its own unit and relative to it.
struct StatedError {
  double value = 0.0, relative = 0.0;
  std::string why;
};
struct ErrorStatement {
  std::string of;  // among headlines()
  StatedError sampling, discretisation, rung;
  std::string dominant;  // "sampling", "discretisation", "rung"
};

// How far the model itself is off, relative.
struct ModelError {
  double discretisation = 0.0, rung = 0.0;     // NaN where not measured
  std::map<std::string, double> rung_of = {};  // per headline, where each has its own
  std::vector<double> rung_of_sample = {};     // likewise per sample, in the order of the values
  std::string discretisation_why = {}, rung_why = {};
};

struct ConvergencePoint {
  std::uint64_t samples = 0;
  ReportedInterval interval;
};

struct Estimates {
  std::uint64_t samples = 0, failed = 0;
  std::vector<NamedEstimate> index;
  std::optional<RequirementVerdict> requirement;
  std::vector<ErrorStatement> errors;         // one per headline that has an interval
  std::string headline;                       // the one that a reader looks at first: the requirement's level, or p95
  std::vector<ConvergencePoint> convergence;  // of the headline

  const NamedEstimate& of(const std::string& name) const;
};

// values[k]: of sample k, NaN if it failed; as many as make whole replicates (SamplingDesign::whole_points). `judgement`: of the
// requirement; as a first look where none is given.
Estimates estimate(const std::vector<double>& values, const MonteCarloPlan& plan, const ModelError& model,
                   const std::optional<Judgement>& judgement = std::nullopt);

// One number of the first `count` samples.
ReportedInterval estimate_of(const std::string& headline, const std::vector<double>& values, std::uint64_t count,
                             const MonteCarloPlan& plan, double confidence);

// Which headline the requirement, or the reader, is about.
std::string headline_of(const MonteCarloPlan& plan);

}  // namespace boresight
