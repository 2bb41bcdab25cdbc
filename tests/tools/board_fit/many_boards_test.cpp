// Tests the consistency of the lens calibration: the errors found in rendered images must agree with the covariance.

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/rendered_boards.hpp"
#include "tools/board_fit/board_calibration.hpp"

namespace azimuth {
namespace {

constexpr int kFound = kLensNumbers - 1;  // the rotation about the optical axis is not estimated

SeenBoards rendered_and_seen(std::size_t images, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const CameraModel camera = test::camera_185();
  SeenBoards seen;
  seen.format = packed_format(PixelFormat::gray8, test::kSide_px, test::kSide_px);
  for (std::size_t i = 0; i < images; ++i) {
    const auto pose = test::board_somewhere(camera, test::kSide_px, test::kChessboard, 1.45, random);
    const auto image = test::rendered(camera, test::kSide_px, test::kChessboard, pose, 4.0, random);
    seen.images.emplace_back(std::to_string(i));
    if (auto corners = find_chessboard(image.view(), test::kChessboard))
      seen.sightings.push_back({i, *std::move(corners)});
    else
      seen.without.push_back(seen.images.back());
  }
  return seen;
}

struct Tally {
  int within = 0, numbers = 0, found = 0, images = 0;
  double nees = 0.0, worst_px = 0.0;
};

void count(const SeenBoards& seen, Tally& tally) {
  std::string problem;
  const auto found = calibrate_by_boards(test::kChessboard, seen, unknown_fisheye(seen.format), std::nullopt, problem);
  ASSERT_TRUE(found) << problem;
  const LensVector off = found->solution.lens.numbers() - test::lens_185().numbers();
  const Eigen::Matrix<double, kFound, kFound> covariance = found->solution.covariance.topLeftCorner<kFound, kFound>();
  const double nees = off.head<kFound>().dot(covariance.ldlt().solve(off.head<kFound>())) / kFound;
  std::string line;
  for (int k = 0; k < kFound; ++k) {
    const double sigmas = off[k] / std::sqrt(covariance(k, k));
    tally.within += std::abs(sigmas) < 2.0;
    ++tally.numbers;
    line += fmt::format(" {:5.1f}", sigmas);
  }
  fmt::print("residual {:.3f} px, off by standard deviations{}, NEES {:.2f} of 1\n", found->solution.rms_px(), line,
             nees);
  tally.nees += nees;
  tally.worst_px = std::max(tally.worst_px, found->solution.rms_px());
  tally.found += static_cast<int>(seen.sightings.size());
  tally.images += static_cast<int>(seen.images.size());
}

TEST(ManyBoards, ErrorsAreWithinTwoStandardDeviations) {
  constexpr int kLenses = 20;
  Tally tally;
  for (std::uint64_t seed = 1; seed <= kLenses; ++seed) count(rendered_and_seen(12, seed), tally);
  fmt::print("boards found in {} of {} images, {} of {} numbers within two standard deviations, NEES {:.2f} of 1\n",
             tally.found, tally.images, tally.within, tally.numbers, tally.nees / kLenses);
  EXPECT_GT(tally.found, 0.95 * tally.images);
  EXPECT_GT(tally.within, 0.88 * tally.numbers);  // 95.4 % are expected over 20 independent lenses
  EXPECT_LT(tally.nees / kLenses, 1.6);
  EXPECT_LT(tally.worst_px, 0.3);
}

}  // namespace
}  // namespace azimuth
