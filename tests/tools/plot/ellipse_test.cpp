#include <Eigen/LU>
#include <cmath>
#include <gtest/gtest.h>

#include "tools/plot/map_picture.hpp"

namespace azimuth {
namespace {

TEST(Ellipse, IsThatOfTwoSigma) {
  const UncertainPoint point{{3.0, -1.0}, Eigen::Vector2d(0.09, 0.01).asDiagonal()};
  EXPECT_NEAR(semi_major_m(point), 0.6, 1e-12);
  Eigen::Vector2d low = point.p_map_m, high = point.p_map_m;
  for (const Eigen::Vector2d& corner : ellipse_outline_m(point)) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
    const Eigen::Vector2d from_middle = corner - point.p_map_m;
    EXPECT_NEAR(from_middle.dot(point.covariance_m2.inverse() * from_middle), 4.0, 1e-9);
  }
  EXPECT_TRUE((high - low).isApprox(Eigen::Vector2d(1.2, 0.4), 1e-9));
}

TEST(Ellipse, OfNoNumberHasNoEnd) {
  EXPECT_TRUE(std::isinf(semi_major_m({{0.0, 0.0}, Eigen::Matrix2d::Constant(NAN)})));
  EXPECT_EQ(semi_major_m({{0.0, 0.0}, Eigen::Matrix2d::Zero()}), 0.0);
}

TEST(EllipseInk, FadesWithSizeAndEndsWhereTheEllipseIsLargerThanTheView) {
  EXPECT_EQ(ellipse_ink(0.3, 10.0), 1.0);
  EXPECT_EQ(ellipse_ink(0.5, 10.0), 1.0);
  double before = 1.0;
  for (double semi_major = 0.6; semi_major < 5.0; semi_major += 0.1) {
    const double ink = ellipse_ink(semi_major, 10.0);
    EXPECT_LT(ink, before);
    EXPECT_GT(ink, 0.0);
    EXPECT_NEAR(ink * ink * semi_major * semi_major, 0.25, 1e-9) << "as much ink in the area as at the limit";
    before = ink;
  }
  EXPECT_EQ(ellipse_ink(5.1, 10.0), 0.0);
  EXPECT_EQ(ellipse_ink(282.0, 10.0), 0.0) << "a robot that is lost";
  EXPECT_EQ(ellipse_ink(INFINITY, 10.0), 0.0);
  EXPECT_EQ(ellipse_ink(NAN, 10.0), 0.0);
}

}  // namespace
}  // namespace azimuth
