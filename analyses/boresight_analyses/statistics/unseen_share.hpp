// What a design may hide of which no sample was bad, whose samples depend on each other (Latin hypercube, scrambled net).
//
// Of n replicates, independent of each other, that none holds a bad sample has at least the chance r where each of them holds one with a chance
// of at most q = 1 - r^(1/n) (Clopper, Pearson 1934). Where a replicate of m samples holds any, it holds two on the average at the most: its
// samples lie apart, but the share of bad ones can follow the strata, so that two of them come more often than chance would have it. The
// share of bad ones is then at most 2 q / m, and never less than as many independent samples may hide.
#pragma once

#include <cstdint>

namespace boresight {

// The largest share of bad ones, at this risk. size: samples of a replicate.
double unseen_share(std::int64_t replicates, double size, double risk);

}  // namespace boresight
