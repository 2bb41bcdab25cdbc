// Tests the consistency of the lens fit: the errors over many drives must agree with the covariance.

#include <Eigen/Cholesky>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/tools/lens_fit/simulated_lens_drive.hpp"
#include "tools/lens_fit/fisheye_calibration.hpp"

namespace azimuth {
namespace {

TEST(ManyLenses, ErrorsAreWithinTwoStandardDeviations) {
  constexpr int kDrives = 40;
  int within = 0, all = 0;
  double nees = 0.0;
  for (std::uint64_t seed = 1; seed <= kDrives; ++seed) {
    const auto drive = test::simulated_lens_drive({.seed = seed});
    LensFitStart map = map_lamps(drive.motions, drive.images, drive.truth.lens, *drive.priors.lamp_height_m, {});
    const auto found = fit_lens(map.drive, map.start, drive.priors);
    ASSERT_TRUE(found);
    const LensVector off = found->lens.numbers() - drive.truth.lens.numbers();
    const Eigen::Matrix<double, kLensNumbers, kLensNumbers> covariance =
        found->covariance.topLeftCorner<kLensNumbers, kLensNumbers>();
    nees += off.dot(covariance.ldlt().solve(off)) / kLensNumbers / kDrives;
    for (int k = 0; k < kLensNumbers; ++k) {
      within += std::abs(off[k]) < 2.0 * std::sqrt(covariance(k, k));
      ++all;
    }
  }
  fmt::print("{} of {} numbers of lenses within two standard deviations, NEES {:.2f} of 1\n", within, all, nees);
  EXPECT_GT(within, 0.88 * all);  // 95.4 % are expected over 40 independent drives
  EXPECT_LT(nees, 1.6);
}

}  // namespace
}  // namespace azimuth
