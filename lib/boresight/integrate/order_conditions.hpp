// Whether a table is what it claims: order conditions from rooted trees, and the stability function.
//
// One form holds every one-step table here. With k_i = h f(y + sum_j alpha_ij k_j) + h J sum_j gamma_ij k_j,
// y1 = y + sum b_i k_i (gamma = 0: Runge-Kutta, explicit or implicit; gamma lower triangular: Rosenbrock with
// the exact Jacobian), the method has order p if for every rooted tree t of at most p nodes
//
//   sum_i b_i Phi_i(t) = 1 / density(t),
//   Phi_i of a tree with the branches t1 ... tm:  (sum_j (alpha + gamma)_ij Phi_j(t1)) if m = 1,
//                                                 product over the branches of sum_j alpha_ij Phi_j
//                                                 otherwise.
//
// A dense output's weights b(theta) have order p if they meet theta^nodes / density(t) for every theta.
// Hairer, Norsett, Wanner (1993), theorem II.2.13; Hairer and Wanner (1996), theorem IV.7.4.
// The stability function is R(z) = 1 + z b^T (I - z (alpha + gamma))^-1 1.
#pragma once

#include <complex>
#include <string>
#include <vector>

#include "boresight/integrate/explicit_tables.hpp"
#include "boresight/integrate/rosenbrock_tables.hpp"
#include "boresight/math/types.hpp"

namespace boresight {

// A rooted tree: the indices of its branches in the list that it belongs to, in no decreasing order.
struct RootedTree {
  std::vector<int> branches;
  int nodes = 1;
  double density = 1.0;
  std::string picture;  // "[[.].]": a node is a bracket round its branches, a leaf a point
};

// All rooted trees of at most `nodes` nodes, smaller ones first: 1, 1, 2, 4, 9, 20, ... of each size.
std::vector<RootedTree> rooted_trees(int nodes);

struct MethodCoefficients {
  MatX alpha, gamma;
  VecX b, b_embedded;
};
MethodCoefficients coefficients(const ExplicitTable& table);
MethodCoefficients coefficients(const RosenbrockTable& table);

// Weights of the dense output at theta, for the coefficients given beside them. Where an explicit table's
// dense output uses the slope at the end of the step and no stage is it, the coefficients gain that stage.
struct DenseWeights {
  MethodCoefficients method;
  VecX b;
};
DenseWeights dense_weights(const ExplicitTable& table, double theta);
DenseWeights dense_weights(const RosenbrockTable& table, double theta);

struct OrderResidual {
  RootedTree tree;
  double residual;  // sum_i b_i Phi_i - theta^nodes / density
};
// Of every tree of at most `order` nodes.
std::vector<OrderResidual> order_residuals(const MethodCoefficients& method, const VecX& b, int order,
                                           double theta = 1.0);
// The largest order up to which every residual stays below `tolerance` (at most `highest`).
int attained_order(const MethodCoefficients& method, const VecX& b, int highest, double tolerance = 1e-12,
                   double theta = 1.0);

std::complex<double> stability_function(const MethodCoefficients& method, std::complex<double> z);
// Where |R| first exceeds 1 on the way out from 0 along -1 or i; `farthest` if it never does before that.
double stability_limit(const MethodCoefficients& method, std::complex<double> direction, double farthest = 50.0);

}  // namespace boresight
