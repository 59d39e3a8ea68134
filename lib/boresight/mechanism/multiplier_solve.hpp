// The multipliers of constraints: A lambda = b, A = J W J^T or Z Z^T, block by block (Sun et al., Eq. 41 with vdot eliminated).
//
// Where rows depend on each other everywhere (a redundant mechanism), A is singular but b lies in its range. The diagonal is
// then raised by kRegularisation of itself, and the solution refined: each pass shrinks what the regularisation did by
// kRegularisation over the smallest nonzero eigenvalue (relative), so two of them bring it back to rounding. Of the many
// solutions this finds the one with (nearly) the least multipliers. Source: Bjorck (1996), Numerical Methods for Least
// Squares Problems, section 2.9.2 (iterated regularisation).
#pragma once

#include <vector>

#include "boresight/math/block_cholesky.hpp"

namespace boresight {

// Small enough that kRefinements passes suffice, large enough to factor.
inline constexpr double kRegularisation = 1e-10;
inline constexpr int kRefinements = 2;

// Solves in place with the factors of A (raised where redundant). right, left_over: work space of the same shape.
// remainder(lambda): puts right - A lambda into left_over.
template <typename Remainder>
void solve_multipliers(const BlockCholesky& factors, bool redundant, std::vector<Vec6>& lambda,
                       std::vector<Vec6>& right, std::vector<Vec6>& left_over, const Remainder& remainder) {
  if (!redundant) {
    factors.solve(lambda);
    return;
  }
  for (std::size_t k = 0; k < lambda.size(); ++k) right[k] = lambda[k];
  factors.solve(lambda);
  for (int pass = 0; pass < kRefinements; ++pass) {
    remainder(lambda);
    factors.solve(left_over);
    for (std::size_t k = 0; k < lambda.size(); ++k) lambda[k] += left_over[k];
  }
}

}  // namespace boresight
