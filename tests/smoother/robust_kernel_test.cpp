#include "slam/smoother/robust_kernel.hpp"

#include <gtest/gtest.h>

#include "tests/smoother/printed_kernel.hpp"

namespace azimuth {
namespace {

class RobustKernels : public testing::TestWithParam<RobustKernel> {};

TEST_P(RobustKernels, WeightIsTheSlopeOfTheEnergy) {
  constexpr double kWidth = 2.0, kDifference_chi2 = 1e-6;
  for (const double chi2 : {0.01, 1.0, 3.9, 4.1, 9.0, 100.0}) {
    const double above = kernel_value(GetParam(), kWidth, chi2 + kDifference_chi2).energy;
    const double below = kernel_value(GetParam(), kWidth, chi2 - kDifference_chi2).energy;
    EXPECT_NEAR(kernel_value(GetParam(), kWidth, chi2).weight, 2.0 * (above - below) / (2.0 * kDifference_chi2), 1e-7)
        << chi2;
  }
}

TEST_P(RobustKernels, SmallResidualsCountInFull) {
  const KernelValue value = kernel_value(GetParam(), 2.0, 1e-6);
  EXPECT_NEAR(value.energy, 0.5e-6, 1e-12);
  EXPECT_NEAR(value.weight, 1.0, 1e-6);
}

TEST_P(RobustKernels, EnergyGrowsAndWeightFalls) {
  KernelValue last = kernel_value(GetParam(), 2.0, 0.0);
  EXPECT_EQ(last.energy, 0.0);
  for (double chi2 = 0.5; chi2 < 50.0; chi2 += 0.5) {
    const KernelValue value = kernel_value(GetParam(), 2.0, chi2);
    EXPECT_GT(value.energy, last.energy);
    EXPECT_LE(value.weight, last.weight);
    EXPECT_GT(value.weight, 0.0);
    last = value;
  }
}

INSTANTIATE_TEST_SUITE_P(All, RobustKernels,
                         testing::Values(RobustKernel::none, RobustKernel::huber, RobustKernel::cauchy,
                                         RobustKernel::dcs),
                         testing::PrintToStringParamName());

TEST(RobustKernel, OnlyDcsIsBounded) {
  EXPECT_LT(kernel_value(RobustKernel::dcs, 2.0, 1e9).energy, 6.0);
  EXPECT_GT(kernel_value(RobustKernel::cauchy, 2.0, 1e9).energy, 30.0);
  EXPECT_NEAR(kernel_value(RobustKernel::huber, 2.0, 100.0).energy, 2.0 * 10.0 - 2.0, 1e-12);
}

}  // namespace
}  // namespace azimuth
