// Estimates from designs whose samples depend on each other (Latin hypercube, scrambled Sobol'): the design is drawn
// several times, each time scrambled anew and independently, and the scatter over these replicates makes the interval.
//
//   const ReplicatedSamples samples({{...}, {...}, ...});   // one list per replicate, all of the same size
//   const ReplicatedInterval worst = samples.quantile(0.9973, 0.95);
//
// Student's t over the replicates (Owen 1997; L'Ecuyer, Lemieux 2002); shares, which lie on a lattice, are never bounded closer than gaffke.hpp
// bounds them. Failed samples as in independent_samples.hpp.
#pragma once

#include <cstdint>
#include <vector>

#include "boresight_analyses/statistics/interval.hpp"

namespace boresight {

class ReplicatedSamples {
 public:
  // `failed` per replicate, or empty. Throws std::invalid_argument for fewer than two replicates, for replicates of
  // different sizes (failed included), or a value that is not finite.
  explicit ReplicatedSamples(std::vector<std::vector<double>> replicates, std::vector<std::int64_t> failed = {});

  std::int64_t replicates() const { return static_cast<std::int64_t>(sorted_.size()); }
  std::int64_t valued() const { return static_cast<std::int64_t>(pooled_.size()); }
  std::int64_t failed() const { return all_failed_; }
  std::int64_t count() const { return valued() + all_failed_; }
  const std::vector<double>& pooled() const { return pooled_; }  // ascending

  ReplicatedInterval mean(double confidence) const;
  // The pooled sd; Student's t on the replicates' mean squares. They are skewed where the tail carries the variance, and
  // few replicates then scatter too little: the interval is never narrower than Bonett's for as many independent samples.
  ReplicatedInterval sd(double confidence) const;
  // Woodruff (1952): the interval of the share below the pooled quantile, from its scatter over replicates and on the
  // logit scale, read back through the pooled samples. A side with fewer than five samples beyond the quantile is left
  // unbounded.
  ReplicatedInterval quantile(double p, double confidence) const;
  // P(value <= limit), failed samples bad; on the logit scale. Where all samples are good (bad) the replicates do not
  // scatter; the bound is then that of unseen_share.hpp.
  ReplicatedInterval probability_below(double limit, double confidence) const;

 private:
  std::vector<std::vector<double>> sorted_;  // per replicate
  std::vector<std::int64_t> failed_;
  std::vector<double> pooled_;
  std::int64_t all_failed_ = 0;
};

// Mean of independent, identically distributed replicate values: Student's t, or Hall's for skewed ones (hall.hpp), the wider on either side. What
// a design leaves of a long tail is the scatter within its last strata, skewed as these are. Of 16 hypercubes of 64 lognormal values (ln sd 1) it
// misses the mean 7 times in 100 where it promises 5, Student's alone 13; of those with ln sd 1.5, 9 and 17. Needs two.
ReplicatedInterval mean_over_replicates(const std::vector<double>& values, double confidence);

}  // namespace boresight
