#include "slam/association/chi_square.hpp"

#include <gtest/gtest.h>

namespace azimuth {
namespace {

struct TableValue {
  int degrees_of_freedom;
  double at_50, at_95, at_99, at_999, at_9999;  ///< Quantiles of 0.5, 0.95, 0.99, 0.999 and 0.9999
};

// Values from printed tables of the chi-square distribution.
constexpr TableValue kTable[]{
    {1, 0.45494, 3.84146, 6.63490, 10.8276, 15.1367},  {2, 1.38629, 5.99146, 9.21034, 13.8155, 18.4207},
    {3, 2.36597, 7.81473, 11.3449, 16.2662, 21.1075},  {4, 3.35669, 9.48773, 13.2767, 18.4668, 23.5127},
    {5, 4.35146, 11.0705, 15.0863, 20.5150, 25.7448},  {10, 9.34182, 18.3070, 23.2093, 29.5883, 35.5640},
    {20, 19.3374, 31.4104, 37.5662, 45.3147, 52.3860}, {50, 49.3349, 67.5048, 76.1539, 86.6608, 95.9687},
};

TEST(ChiSquareQuantile, AgreesWithTheTable) {
  for (const TableValue& row : kTable) {
    const int n = row.degrees_of_freedom;
    SCOPED_TRACE(n);
    EXPECT_NEAR(chi_square_quantile(n, 0.5) / row.at_50, 1.0, 0.01);
    EXPECT_NEAR(chi_square_quantile(n, 0.95) / row.at_95, 1.0, 0.01);
    EXPECT_NEAR(chi_square_quantile(n, 0.99) / row.at_99, 1.0, 0.01);
  }
}

TEST(ChiSquareQuantile, FarInTheTailItErrsByLittleAndTowardsAWiderGate) {
  for (const TableValue& row : kTable) {
    const int n = row.degrees_of_freedom;
    SCOPED_TRACE(n);
    EXPECT_NEAR(chi_square_quantile(n, 0.999) / row.at_999, 1.01, 0.011);
    EXPECT_NEAR(chi_square_quantile(n, 0.9999) / row.at_9999, 1.02, 0.021);
  }
}

TEST(ChiSquareQuantile, IsExactForOneAndTwoDegreesOfFreedom) {
  EXPECT_NEAR(chi_square_quantile(1, 0.99), 6.6348966, 1e-5);
  EXPECT_NEAR(chi_square_quantile(2, 0.99), 9.2103404, 1e-6);
  EXPECT_NEAR(chi_square_quantile(1, 0.6826894921), 1.0, 1e-6);
}

TEST(ChiSquareQuantile, GrowsWithProbabilityAndDegreesOfFreedom) {
  for (int n = 1; n <= 100; ++n)
    for (const double probability : {0.5, 0.7, 0.9, 0.99, 0.999}) {
      EXPECT_LT(chi_square_quantile(n, probability), chi_square_quantile(n, probability + 0.0005));
      EXPECT_LT(chi_square_quantile(n, probability), chi_square_quantile(n + 1, probability));
    }
}

}  // namespace
}  // namespace azimuth
