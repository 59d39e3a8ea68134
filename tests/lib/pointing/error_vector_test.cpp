// The error vector's length is the index, and its components are turns about the axes they are named after.
#include <gtest/gtest.h>

#include "boresight/pointing/indices.hpp"

namespace boresight {
namespace error_vector_test {

Quat turn(double angle, const Vec3& axis) { return Quat(Eigen::AngleAxisd(angle, axis.normalized())); }

class ErrorVector : public testing::Test {
 protected:
  const Pose ideal_{Vec3(0.1, -0.2, 0.5), turn(0.7, Vec3(1, 2, 3))};
  const Pose truth_{Vec3(0.101, -0.198, 0.503), turn(0.01, Vec3(3, -1, 1)) * turn(0.7, Vec3(1, 2, 3))};
};

TEST_F(ErrorVector, IsAsLongAsTheIndexOfItsQuantity) {
  for (const Vec3& boresight_B : {Vec3(0, 0, 1), Vec3(0.6, 0, 0.8), Vec3(0, 0, -1)}) {
    const Pointing pointing{boresight_B, LineOfSight{.from_B = {0.01, 0.02, -0.03}, .target = {0.4, -1.0, 2.0}}};
    const PoseError error = pose_error(truth_, ideal_, pointing);
    const auto length = [&](PointingQuantity q) { return error_vector(q, truth_, ideal_, pointing).norm(); };
    EXPECT_NEAR(length(PointingQuantity::position_error), error.position, 1e-15);
    EXPECT_NEAR(length(PointingQuantity::orientation_error), error.orientation, 1e-14);
    EXPECT_NEAR(length(PointingQuantity::boresight_error), error.boresight, 1e-14);
    EXPECT_NEAR(length(PointingQuantity::line_of_sight_error), error.line_of_sight, 1e-14);
  }
}

TEST_F(ErrorVector, OfTheBoresightIsTheTurnAboutTheBodysOwnAxesAcrossIt) {
  for (int axis = 0; axis < 3; ++axis) {
    const Pose turned{ideal_.p, ideal_.q * turn(1e-3, Vec3::Unit(axis))};
    const Vec3 expected = axis < 2 ? Vec3(1e-3 * Vec3::Unit(axis)) : Vec3::Zero();  // turning about itself moves it not
    EXPECT_LT((error_vector(PointingQuantity::boresight_error, turned, ideal_, Pointing{}) - expected).norm(), 1e-15);
    const Vec3 all = error_vector(PointingQuantity::orientation_error, turned, ideal_, Pointing{});
    EXPECT_LT((all - 1e-3 * Vec3::Unit(axis)).norm(), 1e-15);
  }
}

TEST_F(ErrorVector, StaysExactForTurnsThatAreNotSmall) {
  const Pose turned{ideal_.p, ideal_.q * turn(1.2, Vec3(1, 1, 0))};
  const Vec3 error = error_vector(PointingQuantity::boresight_error, turned, ideal_, Pointing{});
  EXPECT_NEAR(error.norm(), 1.2, 1e-14);
  EXPECT_NEAR(error.x(), error.y(), 1e-14);
}

}  // namespace error_vector_test
}  // namespace boresight
