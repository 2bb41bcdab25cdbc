#include "slam/geometry/halton.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace azimuth {
namespace {

TEST(NormalQuantile, InvertsTheDistribution) {
  for (const double p : {1e-300, 1e-20, 1e-9, 1e-4, 0.02, 0.1, 0.3, 0.4999, 0.5, 0.5001, 0.7, 0.975, 0.9999}) {
    const double back = 0.5 * std::erfc(-normal_quantile(p) / std::sqrt(2.0));
    EXPECT_NEAR(back / p, 1.0, 1e-12) << p;
  }
}

TEST(NormalQuantile, KnownValuesAndSymmetry) {
  EXPECT_EQ(normal_quantile(0.5), 0.0);
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-14);
  EXPECT_NEAR(normal_quantile(0.99), 2.3263478740408408, 1e-14);
  for (const double p : {0.01, 0.2, 0.49}) EXPECT_NEAR(normal_quantile(1.0 - p), -normal_quantile(p), 1e-13);
}

TEST(VanDerCorput, ReversesTheDigits) {
  EXPECT_DOUBLE_EQ(van_der_corput(6, 2), 0.375);         // 110 -> 0.011
  EXPECT_DOUBLE_EQ(van_der_corput(11, 3), 19.0 / 27.0);  // 102 -> 0.201
}

TEST(HaltonNormals, HaveTheMomentsOfIndependentNormals) {
  constexpr int kCount = 1000;
  Eigen::Matrix<double, 8, 1> mean = Eigen::Matrix<double, 8, 1>::Zero();
  Eigen::Matrix<double, 8, 8> second = Eigen::Matrix<double, 8, 8>::Zero();
  for (const auto& point : halton_normal_8d(kCount)) {
    mean += point / kCount;
    second += point * point.transpose() / kCount;
  }
  // A thousand points are only 53 periods of base 19, and each period leaves out 0.
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), 0.03);
  EXPECT_LT((second - Eigen::Matrix<double, 8, 8>::Identity()).cwiseAbs().maxCoeff(), 0.06);
}

TEST(HaltonNormals, AreAPrefixOfEachOther) {
  const auto few = halton_normal_8d(16), many = halton_normal_8d(64);
  for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(few[i], many[i]);
}

}  // namespace
}  // namespace azimuth
