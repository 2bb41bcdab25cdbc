#include "slam/geometry/same_everywhere.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace azimuth {
namespace {

/// Covers the tail as far as double precision reaches, where only the relative error is meaningful.
TEST(ComplementaryError, IsThatOfTheLibrary) {
  for (double x = -7.0; x < 26.0; x += 1.0 / 256.0)
    EXPECT_NEAR(complementary_error(x) / std::erfc(x), 1.0, 1e-14 * std::max(1.0, x)) << x;
}

TEST(ComplementaryError, EndsAtWhatIsCertain) {
  EXPECT_EQ(complementary_error(std::numeric_limits<double>::infinity()), 0.0);
  EXPECT_EQ(complementary_error(-std::numeric_limits<double>::infinity()), 2.0);
  EXPECT_NEAR(complementary_error(0.0), 1.0, 1e-15);
  EXPECT_TRUE(std::isnan(complementary_error(std::nan(""))));
}

TEST(Hypotenuse, IsTheLibrarysToTheLastBits) {
  for (double a = -3.0; a < 3.0; a += 0.173)
    for (double b = -50.0; b < 50.0; b += 0.71) {
      EXPECT_DOUBLE_EQ(hypotenuse(a, b), std::hypot(a, b)) << a << ", " << b;
      const auto a_float = static_cast<float>(a), b_float = static_cast<float>(b);
      EXPECT_FLOAT_EQ(hypotenuse(a_float, b_float), std::hypot(a_float, b_float)) << a << ", " << b;
    }
}

}  // namespace
}  // namespace azimuth
