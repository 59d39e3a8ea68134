// Dependence between parameters, apart from how each of them scatters: a Gaussian copula. Independent uniform
// coordinates become dependent ones by
//
//   z = Phi^-1(u),   y = L z with L L^T = R,   v = Phi(y),
//
// so each v stays uniform and the normal scores y have the correlation matrix R.
// Kendall's tau = 2/pi asin(r), Spearman's rho = 6/pi asin(r/2) of the normal-score correlation r (Kruskal 1958).
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace boresight {

double normal_from_spearman(double rank_correlation);
double normal_from_kendall(double tau);

class GaussianCopula {
 public:
  GaussianCopula() = default;  // independent
  // `correlation`: symmetric, ones on its diagonal. Throws std::domain_error if it is not positive definite.
  explicit GaussianCopula(const Eigen::MatrixXd& correlation);

  bool independent() const { return factor_.size() == 0; }
  // In place. A coordinate that correlates with none before it keeps its bits.
  void apply(std::span<double> coordinates) const;
  // Of two independent points a and b, uniform each: `out` becomes a's dependent coordinates, of which those `renewed` are drawn
  // anew, given the others, by b. With y_a = L z_a and y_b = L z_b, J the renewed ones and K the others,
  //
  //   y_K = y_a,K,    y_J = y_b,J + R_JK R_KK^-1 (y_a,K - y_b,K)
  //
  // has the law of y_J given y_K (Journel, Huijbregts 1978: conditioning by kriging).
  void renew(std::span<const double> a, std::span<const double> b, const std::vector<bool>& renewed,
             std::span<double> out) const;
  // Whether coordinate i depends on any other.
  bool correlated(std::size_t i) const;

 private:
  Eigen::MatrixXd factor_;     // L
  std::vector<bool> changed_;  // per coordinate: some entry beside the diagonal is not zero
};

}  // namespace boresight
