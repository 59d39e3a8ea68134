// R-hat and effective sample sizes beside those of the R package posterior (Buerkner, Gabry, Kay, Vehtari; version 1.4.0 of
// Debian 12): rhat(), ess_bulk(), ess_tail(), ess_mean() of the same chains.
#include "boresight_analyses/posterior/chain_diagnostics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>

namespace boresight {
namespace chain_diagnostics_test {

using Chains = std::vector<std::vector<double>>;

// Four chains of 301 draws, made of the errors e of Park and Miller's generator (1988), the chain's number from 1, and the draw before.
Chains made_of(const std::function<double(double e, int chain, double before)>& next) {
  std::uint64_t s = 12345;
  Chains chains(4);
  for (int c = 0; c < 4; ++c) {
    double before = 0.0;
    for (int k = 0; k < 301; ++k) {
      s = s * 16807 % 2147483647;
      before = next(static_cast<double>(s) / 2147483647.0 - 0.5, c + 1, before);
      chains[static_cast<std::size_t>(c)].push_back(before);
    }
  }
  return chains;
}

struct Expected {
  std::string of;
  Chains chains;
  double r_hat, bulk, tail, mean;
};

TEST(ChainDiagnostics, AreThoseOfTheRPackagePosterior) {
  const std::vector<Expected> all = {
      {"white", made_of([](double e, int, double) { return e; }), 1.000555421, 1192.200186, 1220.456471, 1217.951633},
      {"following one another", made_of([](double e, int, double x) { return 0.9 * x + e; }), 1.05139938, 58.06955331,
       130.2598237, 57.46397234},
      {"alternating", made_of([](double e, int, double x) { return -0.6 * x + e; }), 1.001621964, 3695.017495,
       1034.44351, 3695.017495},
      {"apart", made_of([](double e, int c, double) { return e + 0.2 * c; }), 1.321888372, 9.993600986, 34.03088614,
       10.00615059},
      {"of unlike width", made_of([](double e, int c, double) { return e * c; }), 1.18956336, 1150.346369, 43.80568433,
       1139.057446},
      {"without a variance", made_of([](double e, int, double) { return std::tan(3.1 * e); }), 1.000555421, 1192.200186,
       1220.456471, 1180.995587},
      {"with ties", made_of([](double e, int, double) { return std::floor(4.0 * (e + 0.5)); }), 1.002494967,
       1186.747497, NAN, 1179.018376}};
  for (const Expected& e : all) {
    const ChainDiagnostics found = chain_diagnostics(e.chains);
    EXPECT_NEAR(found.r_hat, e.r_hat, 1e-8) << e.of;
    EXPECT_NEAR(found.bulk_ess / e.bulk, 1.0, 1e-8) << e.of;
    if (std::isfinite(e.tail)) {
      EXPECT_NEAR(found.tail_ess / e.tail, 1.0, 1e-8) << e.of;
    }
    EXPECT_NEAR(mean_ess(e.chains) / e.mean, 1.0, 1e-8) << e.of;
  }
}

TEST(ChainDiagnostics, SayNothingOfDrawsThatAreAllAlike) {
  EXPECT_TRUE(std::isnan(chain_diagnostics(Chains(2, std::vector<double>(20, 3.0))).r_hat));
}

}  // namespace chain_diagnostics_test
}  // namespace boresight
