// The ladder of parallel tempering: exponents beta from 0 (the reference) to 1 (the target), between which neighbours swap their
// places.
//
//   Lambda(beta) = sum of the swaps' rejection rates below beta        the communication barrier
//
// A ladder is best where every swap is rejected as often as every other, and about twice as many steps as Lambda(1) are worth
// having. Syed, Bouchard-Cote, Deligiannidis, Doucet (2022), Non-reversible parallel tempering: a scalable highly parallel MCMC
// scheme, Journal of the Royal Statistical Society B 84, 321-350, sections 4.3 and 5.
#pragma once

#include <vector>

namespace boresight {

// Rising from 0 to 1, `count` >= 2 of them; as close together near 0 as a density of width `narrow` inside a reference of width 1
// asks for.
std::vector<double> first_ladder(int count, double narrow);

// Probability that neighbours at beta1 < beta2, whose log_ratio (ChainPlace) are w1 and w2, swap.
double swap_probability(double beta1, double beta2, double w1, double w2);

double communication_barrier(const std::vector<double>& rejection);

// The ladder on which every swap would be rejected as often as every other. rejection[k]: between k and k + 1.
std::vector<double> evened_ladder(const std::vector<double>& beta, const std::vector<double>& rejection);

}  // namespace boresight
