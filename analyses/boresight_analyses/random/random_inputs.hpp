// What a study scatters, as its [[random]] and [[correlation]] tables say it:
//
//   [[random]]
//   parameter = "clearance.F1.radial"          # one path, or a list of paths that take the same value
//   distribution = { normal = { mean = "0.1 mm", sd = "0.01 mm" }, truncate = ["0.05 mm", "0.15 mm"] }
//
//   distribution = one of
//     { normal = { mean = .., sd = .. } }            { uniform = { min = .., max = .. } }
//     { lognormal = { median = .., factor = 1.3 } }  sd of ln x is ln(factor): 68 % within median / and * factor
//     { triangular = { min = .., mode = .., max = .. } }
//     { beta = { alpha = 2, beta = 3, min = .., max = .. } }
//     { weibull = { shape = 1.5, scale = .., location = .. } }                      location: 0 if left out
//     { discrete = { values = [..], probabilities = [..] } }                        equal ones if left out
//     { empirical = { file = "gaps.csv", column = "gap", unit = "mm" } }            resampled
//     { fit = "20 H7/g6", zone = "normal" }          of a radial clearance, of its journal's size (fit_size.hpp); zone =
//                                                      "uniform": see fit_clearance.hpp
//     { planes = { width = .. } }                    a tolerance zone of ISO 1101: read_zone.hpp; zone = as for a fit
//   and optionally truncate = [low, high]; the distribution between them, renormalised.
//
//   [[random]]
//   parameters = ["gravity.x", "gravity.y"]    # two that are drawn together, as a point of a disc: tolerance_disc.hpp
//   distribution = { cylinder = { diameter = ".." }, zone = "uniform" }
//
//   [[random]]
//   parameters = ["clearance.F1.radial", ..]   # any number that are drawn together, as a row of a table: sample_rows.hpp
//   distribution = { rows = { file = "draws.csv" } }
//
// Each of them is a parameter with its own distribution, that of the disc's coordinate or of its column, and takes a coordinate of the
// unit cube. What they do cannot be told apart, so they are one group wherever parameters are grouped.
//
//   [[correlation]]
//   parameters = ["clearance.F1.radial", "clearance.F1.friction.coefficient"]
//   coefficient = 0.5
//   measure = "normal"                         # of the normal scores behind them; or "spearman", "kendall"
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "boresight/io/cursor.hpp"
#include "boresight/mechanism/mechanism.hpp"
#include "boresight/mechanism/parameter_path.hpp"
#include "boresight_analyses/random/copula.hpp"
#include "boresight_analyses/random/distribution.hpp"
#include "boresight_analyses/random/tolerance_disc.hpp"

namespace boresight {

struct RandomParameter {
  std::vector<std::string> paths;
  std::string si_unit;
  std::string unit;  // in which the distribution is written: "mm"; "" where it has none
  DistributionPtr distribution;
  std::vector<ParameterPath> places;
  bool are_scales = false;  // of drives: shares, whatever they are computed in

  // What their values are told in where no other unit is said: "1" of scales.
  std::string told_unit() const { return are_scales ? "1" : si_unit; }
  const std::string& name() const { return paths.front(); }
};

// Two parameters, `first` and the next one, that are a point of a disc.
struct DrawnTogether {
  std::size_t first = 0;
  ToleranceDisc disc;
};

struct RandomInputs {
  std::vector<RandomParameter> parameters;
  std::vector<DrawnTogether> zones;  // by ascending `first`
  GaussianCopula copula;
  std::string text;  // all that decides what coordinates become; equal texts are equal inputs

  std::size_t size() const { return parameters.size(); }
  std::vector<std::string> names() const;  // of the parameters
  // Coordinates in the unit cube become values (SI), in place.
  void values(std::span<double> coordinates) const;
  // The values of point a, of which the parameters `renewed` are drawn anew, given the others, by the independent point b.
  void renewed_values(std::span<const double> a, std::span<const double> b, const std::vector<bool>& renewed,
                      std::span<double> values) const;
  // The values with every coordinate at `level`, as if nothing were correlated.
  std::vector<double> values_at(double level) const;
  // The zone that parameter i is of; null: of none.
  const DrawnTogether* zone_of(std::size_t i) const;
  // How parameter i scatters: its distribution, or the zone that it is of.
  std::string text_of(std::size_t i) const;
  // The mechanism's own parameters with these values.
  Parameters parameters_with(const Mechanism& mechanism, std::span<const double> values) const;

 private:
  void apply_quantiles(std::span<double> coordinates) const;
};

// Reads [[random]] and [[correlation]]. Throws InputError: beside what is wrong with an entry itself, a distribution
// that reaches values the mechanism would refuse. `accepts` is asked of one value out of 10^9 at either end, as a
// setting of the mechanism, and throws what the mechanism's own reader throws.
RandomInputs read_random_inputs(Cursor& root, const MechanismDescription& mechanism,
                                const std::function<void(const Setting&)>& accepts);

}  // namespace boresight
