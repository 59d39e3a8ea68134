#include "boresight_analyses/random/sampling_design.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <set>

#include "boresight_analyses/random/counter_stream.hpp"
#include "boresight_analyses/random/permutation.hpp"
#include "validation/printed.hpp"

namespace boresight {
namespace sampling_design_test {

std::vector<double> point(const SamplingDesign& design, std::uint64_t k) {
  std::vector<double> u(static_cast<std::size_t>(design.dimensions()));
  design.point(k, u);
  return u;
}

// Random123's known answers (kat_vectors), philox4x64 with 10 rounds.
TEST(CounterStream, IsPhiloxAsPublished) {
  const r123::Philox4x64 philox;
  const auto zero = philox({{0, 0, 0, 0}}, {{0, 0}});
  validation::PrintedTable table("Salmon and others 2011, Random123, kat_vectors",
                                 "philox4x64, 10 rounds, halves of words", 1e-9);
  const auto expect = [&table](const char* where, std::uint64_t printed, std::uint64_t ours) {
    EXPECT_EQ(printed, ours) << where;
    for (const int half : {0, 32})  // a double holds each
      table.expect(where, static_cast<double>(printed >> half & 0xffffffffu),
                   static_cast<double>(ours >> half & 0xffffffffu));
  };
  expect("zeros, first word", 0x16554d9eca36314cULL, zero[0]);
  expect("zeros, last word", 0x7e68b68aec7ba23bULL, zero[3]);
  const auto pi = philox({{0x243f6a8885a308d3ULL, 0x13198a2e03707344ULL, 0xa4093822299f31d0ULL, 0x082efa98ec4e6c89ULL}},
                         {{0x452821e638d01377ULL, 0xbe5466cf34e90c6cULL}});
  expect("digits of pi, first word", 0xa528f45403e61d95ULL, pi[0]);
}

TEST(CounterStream, NeverReachesZeroOrOne) {
  EXPECT_GT(CounterStream::to_unit(0), 0.0);
  EXPECT_LT(CounterStream::to_unit(~std::uint64_t{0}), 1.0);
}

TEST(SamplingDesign, PointsDependOnSeedAndNumberAlone) {
  for (const SamplingKind kind : {SamplingKind::random, SamplingKind::lhs, SamplingKind::sobol}) {
    const SamplingOptions options{.kind = kind, .seed = 7};
    const SamplingDesign one(options, 3), other(options, 3), wider(options, 5);
    for (const std::uint64_t k : {0ull, 1ull, 999ull, 123456789ull}) {
      EXPECT_EQ(point(one, k), point(other, k));
      std::vector<double> first = point(wider, k);
      first.resize(3);
      EXPECT_EQ(point(one, k), first) << "a further parameter changes none of the others";
      SamplingOptions reseeded = options;
      reseeded.seed = 8;
      EXPECT_NE(point(one, k), point(SamplingDesign(reseeded, 3), k));
    }
  }
}

TEST(SamplingDesign, EachHypercubeHasOnePointInEveryStratumOfEveryDimension) {
  const SamplingDesign design({.kind = SamplingKind::lhs, .seed = 3, .strata = 37}, 4);
  for (std::uint64_t cube = 0; cube < 5; ++cube)
    for (std::size_t d = 0; d < 4; ++d) {
      std::set<int> strata;
      for (std::uint64_t i = 0; i < 37; ++i) strata.insert(static_cast<int>(37.0 * point(design, 37 * cube + i)[d]));
      EXPECT_EQ(strata.size(), 37u);
    }
}

TEST(Permutation, IsAPermutationAndItsElementsGoAnywhere) {
  std::array<int, 7> landed{};
  for (std::uint64_t a = 0; a < 7000; ++a) {
    std::set<std::uint64_t> all;
    for (std::uint64_t i = 0; i < 7; ++i) all.insert(permuted(i, 7, 1, a, 0));
    ASSERT_EQ(all.size(), 7u);
    ++landed[permuted(2, 7, 1, a, 0)];
  }
  double chi_square = 0.0;
  for (const int count : landed) chi_square += (count - 1000.0) * (count - 1000.0) / 1000.0;
  EXPECT_LT(chi_square, 22.5);  // 6 degrees of freedom, one in a thousand
}

// Joe and Kuo's own first points in three dimensions, new-joe-kuo-6.21201.
TEST(SobolNet, BeginsAsPublished) {
  const SobolNet net(3);
  const double expected[][3] = {{0, 0, 0}, {0.5, 0.5, 0.5}, {0.25, 0.75, 0.75}, {0.75, 0.25, 0.25}};
  const double fifth_set[][3] = {{0.125, 0.625, 0.375}, {0.625, 0.125, 0.875}};
  std::set<std::array<double, 3>> of_ours, of_theirs;
  const auto at = [&](std::uint64_t k) {
    return std::array<double, 3>{net.bits(k, 0) * 0x1p-32, net.bits(k, 1) * 0x1p-32, net.bits(k, 2) * 0x1p-32};
  };
  for (std::uint64_t k = 0; k < 4; ++k) {
    of_ours.insert(at(k));
    of_theirs.insert({expected[k][0], expected[k][1], expected[k][2]});
  }
  EXPECT_EQ(of_ours, of_theirs);
  validation::PrintedTable table("Joe and Kuo 2008, new-joe-kuo-6.21201",
                                 "first points of the Sobol' net in three dimensions, in any order", 1e-12);
  for (auto ours = of_ours.begin(), theirs = of_theirs.begin(); ours != of_ours.end(); ++ours, ++theirs)
    for (std::size_t d = 0; d < 3; ++d) table.expect("a coordinate", (*theirs)[d], (*ours)[d]);
  std::set<std::array<double, 3>> next;
  for (std::uint64_t k = 4; k < 8; ++k) next.insert(at(k));
  for (const auto& p : fifth_set) EXPECT_TRUE(next.contains({p[0], p[1], p[2]})) << p[0];
}

TEST(SobolNet, AScrambledNetIsStillANetAndKeepsItsFirstPoint) {
  const SobolNet net(5);
  for (std::uint64_t replicate = 0; replicate < 3; ++replicate)
    for (int d = 0; d < 5; ++d) {
      std::set<int> cells;
      for (std::uint64_t k = 0; k < 64; ++k) cells.insert(static_cast<int>(64.0 * net.scrambled(k, d, 11, replicate)));
      EXPECT_EQ(cells.size(), 64u);
      // A (t, m, 2)-net: every elementary box of the first two dimensions holds one point.
      if (d == 0) {
        std::set<std::pair<int, int>> boxes;
        for (std::uint64_t k = 0; k < 64; ++k)
          boxes.insert({static_cast<int>(8.0 * net.scrambled(k, 0, 11, replicate)),
                        static_cast<int>(8.0 * net.scrambled(k, 1, 11, replicate))});
        EXPECT_EQ(boxes.size(), 64u);
      }
    }
}

TEST(SobolNet, EveryPointIsUniformOverScramblings) {
  const SobolNet net(2);
  for (const std::uint64_t k : {0ull, 5ull}) {
    std::array<int, 16> count{};
    for (std::uint64_t replicate = 0; replicate < 4000; ++replicate)
      ++count[static_cast<std::size_t>(16.0 * net.scrambled(k, 1, 5, replicate))];
    double chi_square = 0.0;
    for (const int n : count) chi_square += (n - 250.0) * (n - 250.0) / 250.0;
    EXPECT_LT(chi_square, 37.7);  // 15 degrees of freedom, one in a thousand
  }
}

TEST(SamplingDesign, NetsIntegrateSmoothFunctionsFarBetterThanIndependentPoints) {
  // f = product of (1 + (u_d - 1/2)), integral 1.
  const auto error = [](SamplingKind kind) {
    double squares = 0.0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const SamplingDesign design({.kind = kind, .seed = seed, .strata = 4096, .replicates = 2}, 4);
      double sum = 0.0;
      constexpr int n = 4096;
      for (std::uint64_t k = 0; k < n; ++k) {
        double f = 1.0;
        for (const double u : point(design, k)) f *= 1.0 + (u - 0.5);
        sum += f;
      }
      squares += (sum / n - 1.0) * (sum / n - 1.0);
    }
    return std::sqrt(squares / 20.0);
  };
  const double random = error(SamplingKind::random);
  EXPECT_NEAR(random, std::sqrt((std::pow(13.0 / 12.0, 4) - 1.0) / 4096.0), 0.4 * random);
  EXPECT_LT(error(SamplingKind::lhs), random / 2.5);
  EXPECT_LT(error(SamplingKind::sobol), random / 50.0);
}

TEST(SamplingDesign, SaysWhenANetLosesItsBalance) {
  const SamplingDesign design({.kind = SamplingKind::sobol, .replicates = 16}, 2);
  EXPECT_EQ(design.warning(16 * 512), "");
  EXPECT_NE(design.warning(10000).find("8192 or 16384"), std::string::npos) << design.warning(10000);
  EXPECT_EQ(design.whole_points(10007), 10000u);
  EXPECT_EQ(SamplingDesign({.kind = SamplingKind::random}, 2).warning(10000), "");
  // Whole points are whole nets, or whole hypercubes, or any number.
  EXPECT_EQ(SamplingDesign({.kind = SamplingKind::lhs, .strata = 100, .replicates = 16}, 2).whole_points(10007),
            10000u);
  EXPECT_EQ(SamplingDesign({.kind = SamplingKind::sobol, .strata = 100, .replicates = 16}, 2).whole_points(10090),
            10080u);
  EXPECT_EQ(SamplingDesign({.kind = SamplingKind::random}, 2).whole_points(10007), 10007u);
}

TEST(SamplingDesign, IndependentPointsAreUniformInEveryDimension) {
  const SamplingDesign design({.kind = SamplingKind::random, .seed = 2}, 3);
  for (std::size_t d = 0; d < 3; ++d) {
    std::vector<double> u;
    for (std::uint64_t k = 0; k < 10000; ++k) u.push_back(point(design, k)[d]);
    std::sort(u.begin(), u.end());
    double distance = 0.0;  // Kolmogorov's
    for (std::size_t i = 0; i < u.size(); ++i)
      distance = std::max(distance, std::abs(u[i] - (static_cast<double>(i) + 0.5) / 10000.0));
    EXPECT_LT(distance * 100.0, 1.95);  // one in a thousand
  }
}

}  // namespace sampling_design_test
}  // namespace boresight
