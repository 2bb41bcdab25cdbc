// Drives that last longer than what is kept of them.

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vector>

#include "tests/support/hindsight_drive.hpp"
#include "tests/support/large_hall.hpp"

namespace azimuth {
namespace {

HindsightSettings keeping(int keyframes) {
  HindsightSettings settings;
  settings.max_keyframes = keyframes;
  return settings;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double sigma_heading_rad(const HindsightDrive& drive) {
  Estimate now;
  drive.estimator().estimate(now);
  return std::sqrt(now.pose_covariance(2, 2));
}

void expect_within(const HindsightDrive::Errors& limits, const HindsightDrive::Errors& errors) {
  EXPECT_LT(errors.rmse_m, limits.rmse_m);
  EXPECT_LT(errors.anees, limits.anees);
}

TEST(LongDrive, AFewOfItsImagesAreEnoughToGoBy) {
  // GIVEN some minutes in a hall, and back where it began
  const Scenario scenario = large_hall(1, 5.0, {.landmarks = 60, .side_m = 16.0, .lane_m = 5.0});
  // WHEN no more than 150 of some 700 images are kept
  HindsightDrive drive(scenario, keeping(150));
  while (!drive.done()) drive.hear_s();
  EXPECT_LE(drive.graph().poses(), 150);
  // THEN a fifth of the bearings are enough, and what is said of the error holds
  expect_within({.rmse_m = 0.065, .anees = 3.6}, drive.online());
  expect_within({.rmse_m = 0.05, .anees = 5.0}, drive.hindsight());
}

TEST(LongDrive, StartsFromItsOwnMapMakeItNoSurer) {
  for (const std::uint64_t seed : {1, 2, 3, 5}) {
    // GIVEN a drive round and round a lab, and the same one, but that the daemon is killed every twenty images
    constexpr double kMinutes = 5.0;
    HindsightDrive drive(long_lab(seed, kMinutes), keeping(200)), restarted(long_lab(seed, kMinutes), keeping(200));
    // WHEN it starts from its map each time
    int starts = 0;
    for (int image = 1; !drive.done(); ++image) {
      drive.hear_s();
      restarted.hear_s();
      if (image > 40 && image % 20 == 0 && restarted.start_again()) ++starts;
    }
    ASSERT_GT(starts, 60);
    // THEN it is no better known which way the map is turned, and what is said of the pose holds about as well
    const double sigma_rad = sigma_heading_rad(drive), restarted_rad = sigma_heading_rad(restarted);
    fmt::print(
        "seed {}: {} starts, heading {:.4f} rad, without {:.4f}; ANEES {:.1f}, without {:.1f}; {:.3f} m, {:.3f} m\n",
        seed, starts, restarted_rad, sigma_rad, restarted.online().anees, drive.online().anees,
        restarted.online().rmse_m, drive.online().rmse_m);
    EXPECT_GT(restarted_rad, 0.8 * sigma_rad);
    EXPECT_LT(restarted.online().anees, 6.0);
  }
}

TEST(LongDrive, AnImageCostsNoMoreLaterOn) {
  // GIVEN a quarter of an hour round and round a lab, of which little more than the last minute can be kept
  HindsightDrive drive(long_lab(1, 15.0), keeping(200));
  std::vector<double> costs_s;
  while (!drive.done()) costs_s.push_back(drive.hear_s());
  // THEN an image of the last five minutes costs hardly more than one of the second five, and the map stays where it is
  constexpr std::ptrdiff_t some = 1500;
  const double then_s = median({costs_s.begin() + some, costs_s.begin() + 2 * some});
  const double now_s = median({costs_s.end() - some, costs_s.end()});
  EXPECT_LT(now_s, 1.8 * then_s);
  expect_within({.rmse_m = 0.06, .anees = 6.0}, drive.online());
  expect_within({.rmse_m = 0.09, .anees = 5.8}, drive.hindsight());
}

TEST(LongDrive, HundredsOfPriorsDoNotBendIt) {
  // GIVEN a drive along the wall of a large hall, where all landmarks are begun at the edge of what is in view
  HindsightDrive drive(large_hall(6, 3.2), keeping(1500));
  while (to_seconds(drive.next()) < 190.0) drive.hear_s();
  expect_within({.rmse_m = 0.2, .anees = 2.4}, drive.online());
  expect_within({.rmse_m = 0.13, .anees = 2.8}, drive.hindsight());
}

}  // namespace
}  // namespace azimuth
