// What a residual costs: that its slope, its score and its weight belong together.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "boresight_analyses/calibration/calibration_problem.hpp"

namespace boresight {
namespace residual_loss_test {

TEST(ResidualLoss, HasTheSlopeScoreAndWeightOfItsOwnResidual) {
  constexpr double kStep = 1e-5;
  for (const Loss kind : {Loss::none, Loss::huber, Loss::cauchy})
    for (const double scale : {0.7, 2.4})
      for (const double r : {-6.0, -1.3, -0.2, 0.4, 2.0, 9.0}) {
        const ResidualLoss loss{kind, scale};
        const double slope = (loss.residual(r + kStep) - loss.residual(r - kStep)) / (2.0 * kStep);
        const double curvature = (loss.score(r + kStep) - loss.score(r - kStep)) / (2.0 * kStep);
        EXPECT_NEAR(loss.slope(r), slope, 1e-8) << static_cast<int>(kind) << ", " << scale << ", " << r;
        EXPECT_NEAR(loss.score(r), loss.residual(r) * slope, 1e-7)
            << static_cast<int>(kind) << ", " << scale << ", " << r;
        EXPECT_NEAR(loss.weight(r), std::max(0.0, curvature), 1e-7)
            << static_cast<int>(kind) << ", " << scale << ", " << r;
      }
}

// Huber (1964): 2 c |r| - c^2 beyond c. Cauchy: c^2 ln(1 + r^2 / c^2).
TEST(ResidualLoss, IsHubersOrCauchys) {
  const auto square = [](const ResidualLoss& loss, double r) { return loss.residual(r) * loss.residual(r); };
  EXPECT_NEAR(square({Loss::huber, 2.0}, -5.0), 2.0 * 2.0 * 5.0 - 4.0, 1e-12);
  EXPECT_NEAR(square({Loss::huber, 2.0}, 1.5), 1.5 * 1.5, 1e-12);
  EXPECT_NEAR(square({Loss::cauchy, 2.0}, -5.0), 4.0 * std::log(1.0 + 25.0 / 4.0), 1e-12);
  EXPECT_LT((ResidualLoss{Loss::cauchy, 2.0}.residual(-5.0)), 0.0);
}

}  // namespace residual_loss_test
}  // namespace boresight
