#include "boresight_analyses/calibration/confused_errors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "boresight/math/dense_solves.hpp"
#include "boresight/math/eigenvalues.hpp"
#include "boresight_analyses/calibration/channel_variances.hpp"

namespace boresight {
namespace {

// A variance in place of an infinite one, of sizes.
constexpr double kLeastInformation = 1e-8;
// A share of an error in another's combination that is rounding.
constexpr double kRounding = 1e-9;
// By how much a combination's error may grow by terms that are not named in it.
constexpr double kUnnamed = 1.2;

MatX eliminated(const MatX& H, const std::vector<int>& kept, const std::vector<int>& others) {
  const MatX part = H(kept, kept);
  if (others.empty()) return part;
  const MatX cross = H(kept, others);
  const MatX left = part - cross * solve_least(MatX(H(others, others)), MatX(cross.transpose()));
  return 0.5 * (left + left.transpose());
}

// Each column alone in one row, where it is 1; rows in the order of the columns.
std::vector<int> reduce(MatX& N) {
  std::vector<bool> taken(static_cast<std::size_t>(N.cols()), false);
  std::vector<int> pivot_of(static_cast<std::size_t>(N.cols()), -1);
  for (Eigen::Index step = 0; step < N.cols(); ++step) {
    Eigen::Index row = 0, column = 0;
    double largest = -1.0;
    for (Eigen::Index c = 0; c < N.cols(); ++c) {
      if (taken[static_cast<std::size_t>(c)]) continue;
      Eigen::Index r = 0;
      if (const double here = N.col(c).cwiseAbs().maxCoeff(&r); here > largest) {
        largest = here;
        row = r;
        column = c;
      }
    }
    N.col(column) /= N(row, column);
    for (Eigen::Index c = 0; c < N.cols(); ++c)
      if (c != column) N.col(c) -= N(row, c) * N.col(column);
    taken[static_cast<std::size_t>(column)] = true;
    pivot_of[static_cast<std::size_t>(column)] = static_cast<int>(row);
  }
  return pivot_of;
}

struct Directions {
  VecX values;
  MatX vectors;
};

Directions directions_of(const MatX& M) {
  const Eigen::SelfAdjointEigenSolver<MatX> solver(M);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

int root_of(std::vector<int>& parent, int i) {
  while (parent[static_cast<std::size_t>(i)] != i) i = parent[static_cast<std::size_t>(i)];
  return i;
}

// Without as many of its smallest terms as its error does not grow by: what is left out is counted in it. Terms alike in size go together, as
// errors that are confused among themselves are known in sum only.
template <typename Variance>
VecX without_small_terms(const VecX& whole, int first, const Variance& variance) {
  std::vector<double> sizes;
  for (Eigen::Index f = 0; f < whole.size(); ++f)
    if (f != first && whole[f] != 0.0) sizes.push_back(std::abs(whole[f]));
  std::sort(sizes.begin(), sizes.end());
  const double most = kUnnamed * kUnnamed * variance(whole);
  VecX best = whole;
  for (const double size : sizes) {
    VecX c = whole;
    for (Eigen::Index f = 0; f < c.size(); ++f)
      if (f != first && std::abs(c[f]) <= size * (1.0 + 1e-4)) c[f] = 0.0;
    if (variance(c) <= most) best = c;
  }
  return best;
}

}  // namespace

std::vector<ConfusedErrors> confused_errors(const CalibrationProblem& problem, const Globals& globals,
                                            const KnownOfErrors& known, const std::vector<bool>& fixed) {
  std::vector<int> errors, others;
  for (int g = 0; g < problem.global_count(); ++g) {
    const bool parameter = g < problem.parameter_count();
    if (parameter && !fixed.empty() && fixed[static_cast<std::size_t>(g)]) continue;
    (parameter && problem.parameters[static_cast<std::size_t>(g)].is_error() ? errors : others).push_back(g);
  }
  const int count = static_cast<int>(errors.size());
  if (count == 0) return {};
  const auto parameter = [&](int i) -> const FittedParameter& {
    return problem.parameters[static_cast<std::size_t>(errors[static_cast<std::size_t>(i)])];
  };
  const double s2 = known.variance_factor, least_seen = 1.0 / (kUnknown * kUnknown);
  const Directions seen = directions_of(eliminated(known.data_information, errors, others) / s2);
  const Directions all = directions_of(eliminated(known.information, errors, others));
  // What the other unknowns do as these move, and what was known before of both.
  const MatX led = others.empty()
                       ? MatX(0, count)
                       : solve_least(MatX(known.information(others, others)), MatX(known.information(others, errors)));
  const VecX told = problem.prior_information();
  const MatX alone = known.data_information(errors, errors) / s2;
  const int unseen = static_cast<int>((seen.values.array() < least_seen).count());
  if (unseen == 0) return {};
  MatX N = seen.vectors.leftCols(unseen);  // values rise
  bool hidden = false;
  for (int k = 0; k < unseen; ++k) hidden = hidden || N.col(k).dot(alone * N.col(k)) > least_seen;
  const std::vector<int> pivots = reduce(N);
  const auto deviation = [&](int i) {
    const int g = errors[static_cast<std::size_t>(i)];
    return std::sqrt(known.covariance(g, g));
  };
  // Those whose own error is small enough are known, whatever little the directions have of them.
  std::vector<bool> unknown(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) unknown[static_cast<std::size_t>(i)] = !(deviation(i) < kUnknown);
  // How all unknowns go with a combination, what the data hardly see left out.
  const auto along = [&](const VecX& c) {
    VecX seen_y = VecX::Zero(count);
    for (int k = 0; k < count; ++k)
      if (all.values[k] > kHardlySeen * all.values[count - 1])
        seen_y += c.dot(all.vectors.col(k)) / all.values[k] * all.vectors.col(k);
    VecX z = VecX::Zero(problem.global_count());
    z(errors) = seen_y;
    if (!others.empty()) z(others) = -led * seen_y;
    return z;
  };
  const auto variance = [&](const VecX& c) {
    VecX y = VecX::Zero(count);  // M^-1 c
    for (int k = 0; k < count; ++k)
      y += c.dot(all.vectors.col(k)) / std::max(all.values[k], kLeastInformation) * all.vectors.col(k);
    const VecX y_others = led * y, z = along(c);
    const double of_the_told =
        told(errors).dot(y.cwiseAbs2()) + (others.empty() ? 0.0 : told(others).dot(y_others.cwiseAbs2()));
    double growth = 1.0;
    for (int i = 0; i < count; ++i)
      if (c[i] != 0.0) growth = std::max(growth, known.growth[errors[static_cast<std::size_t>(i)]]);
    // As in inference.hpp.
    return growth * (s2 * c.dot(y) - (s2 - 1.0) * of_the_told + z.dot(known.departure * z));
  };
  std::vector<int> parent(static_cast<std::size_t>(count));
  std::iota(parent.begin(), parent.end(), 0);
  std::vector<bool> is_pivot(static_cast<std::size_t>(count), false);
  for (const int f : pivots) is_pivot[static_cast<std::size_t>(f)] = true;
  struct Found {
    int error;
    VecX c;
    double variance;
  };
  std::vector<Found> combinations;
  for (int i = 0; i < count; ++i) {
    if (!unknown[static_cast<std::size_t>(i)] || is_pivot[static_cast<std::size_t>(i)]) continue;
    VecX c = VecX::Unit(count, i);
    for (int k = 0; k < unseen; ++k)
      if (std::abs(N(i, k)) > kRounding) c[pivots[static_cast<std::size_t>(k)]] = -N(i, k);
    c = without_small_terms(c, i, variance);
    for (int f = 0; f < count; ++f)
      if (c[f] != 0.0) parent[static_cast<std::size_t>(root_of(parent, f))] = root_of(parent, i);
    combinations.push_back({i, c, variance(c)});
  }
  std::vector<ConfusedErrors> groups;
  for (int root = 0; root < count; ++root) {
    ConfusedErrors group;
    group.hidden = hidden;
    for (int i = 0; i < count; ++i)
      if (unknown[static_cast<std::size_t>(i)] && root_of(parent, i) == root)
        group.parameters.push_back(errors[static_cast<std::size_t>(i)]);
    if (group.parameters.empty()) continue;
    for (const Found& found : combinations) {
      if (root_of(parent, found.error) != root) continue;
      KnownCombination combination;
      const double size = parameter(found.error).size;
      combination.si_unit = parameter(found.error).si_unit;
      combination.told_unit = parameter(found.error).told_unit();
      combination.terms.emplace_back(errors[static_cast<std::size_t>(found.error)], 1.0);
      for (int f = 0; f < count; ++f)
        if (f != found.error && found.c[f] != 0.0)
          combination.terms.emplace_back(errors[static_cast<std::size_t>(f)], found.c[f] * size / parameter(f).size);
      for (const auto& [g, coefficient] : combination.terms)
        combination.value += coefficient * problem.parameters[static_cast<std::size_t>(g)].value(globals.u[g]);
      combination.standard_error = size * std::sqrt(found.variance);
      const double half = known.quantile(along(found.c)) * combination.standard_error;
      combination.low = combination.value - half;
      combination.high = combination.value + half;
      // One that is not known either is no news.
      if (combination.standard_error < kUnknown * size) group.known.push_back(std::move(combination));
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

std::string in_words(const KnownCombination& combination, const std::vector<FittedParameter>& parameters) {
  std::string words;
  for (const auto& [g, coefficient] : combination.terms) {
    const FittedParameter& p = parameters[static_cast<std::size_t>(g)];
    if (words.empty()) {
      words = p.path;
      continue;
    }
    char factor[40];
    std::snprintf(factor, sizeof factor, "%.3g", std::abs(coefficient));
    words += coefficient < 0.0 ? " - " : " + ";
    const std::string &over = combination.told_unit, under = p.told_unit();
    if (over != under)
      words += std::string(factor) + " " + (under == "1" ? over : over + "/" + under) + " ";
    else if (std::string(factor) != "1")
      words += std::string(factor) + " ";
    words += p.path;
  }
  return words;
}

std::string in_words(const ConfusedErrors& group, const std::vector<FittedParameter>& parameters) {
  const auto listed = [](const std::vector<std::string>& texts) {
    std::string out;
    for (std::size_t k = 0; k < texts.size(); ++k)
      out += (k == 0 ? "" : k + 1 == texts.size() ? " and " : ", ") + texts[k];
    return out;
  };
  std::vector<std::string> names, known;
  for (const int g : group.parameters) names.push_back(parameters[static_cast<std::size_t>(g)].path);
  for (const KnownCombination& c : group.known) known.push_back(in_words(c, parameters));
  const std::string why =
      group.hidden ? " What else is fitted (offsets of the channels, contacts) does as they do." : "";
  if (known.empty())
    return "These data say nothing of " + listed(names) + ": the boresight hardly moves by " +
           (names.size() == 1 ? "it." : "them.") + why;
  return listed(names) + " move the boresight alike in these data: only " + listed(known) +
         (known.size() == 1 ? " is known." : " are known.") + why;
}

}  // namespace boresight
