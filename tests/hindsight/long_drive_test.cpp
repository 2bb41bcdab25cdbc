// Drives that are longer than the number of images the smoother keeps.

#include <algorithm>
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

void expect_within(const HindsightDrive::Errors& limits, const HindsightDrive::Errors& errors) {
  EXPECT_LT(errors.rmse_m, limits.rmse_m);
  EXPECT_LT(errors.anees, limits.anees);
}

TEST(LongDrive, AFewOfItsImagesAreEnoughToGoBy) {
  // GIVEN a drive of some minutes in a hall, back to its start
  const Scenario scenario = large_hall(1, 5.0, {.landmarks = 60, .side_m = 16.0, .lane_m = 5.0});
  // WHEN no more than 150 of some 700 images are kept
  HindsightDrive drive(scenario, keeping(150));
  while (!drive.done()) drive.hear_s();
  EXPECT_LE(drive.graph().poses(), 150);
  // THEN a fifth of the bearings is enough, and the covariance agrees with the error
  expect_within({.rmse_m = 0.065, .anees = 3.6}, drive.online());
  expect_within({.rmse_m = 0.05, .anees = 5.0}, drive.hindsight());
}

TEST(ManyStarts, FromItsOwnMapMakeItNoSurerThanItIs) {
  constexpr int kSeeds = 8;
  constexpr double kMinutes = 5.0;
  double anees = 0.0, restarted_anees = 0.0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    // GIVEN a long drive round a lab, and the same drive with a daemon that is killed every twenty images
    const Scenario scenario = long_lab(static_cast<std::uint64_t>(seed), kMinutes);
    HindsightDrive drive(scenario, keeping(200)), restarted(scenario, keeping(200));
    // WHEN the daemon starts from its map each time
    int starts = 0;
    for (int image = 1; !drive.done(); ++image) {
      drive.hear_s();
      restarted.hear_s();
      if (image > 40 && image % 20 == 0 && restarted.start_again()) ++starts;
    }
    EXPECT_GT(starts, 60);
    const HindsightDrive::Errors without = drive.online(), with = restarted.online();
    fmt::print("seed {}: {} starts, ANEES {:.1f} (without {:.1f}), RMSE {:.3f} m ({:.3f} m)\n", seed, starts,
               with.anees, without.anees, with.rmse_m, without.rmse_m);
    anees += without.anees / kSeeds;
    restarted_anees += with.anees / kSeeds;
  }
  // THEN the pose's covariance agrees with the error (ideal ANEES: 3, one for each of x, y and heading)
  fmt::print("mean ANEES {:.1f}, without starts {:.1f}\n", restarted_anees, anees);
  EXPECT_LT(restarted_anees, 3.0);
}

TEST(LongDrive, AnImageCostsNoMoreLaterOn) {
  // GIVEN a drive of a quarter of an hour round a lab, of which little more than the last minute can be kept
  HindsightDrive drive(long_lab(1, 15.0), keeping(200));
  std::vector<double> costs_s;
  while (!drive.done()) costs_s.push_back(drive.hear_s());
  // THEN an image of the last five minutes costs hardly more than one of the second five, and the map does not drift
  constexpr std::ptrdiff_t some = 1500;
  const double then_s = median({costs_s.begin() + some, costs_s.begin() + 2 * some});
  const double now_s = median({costs_s.end() - some, costs_s.end()});
  EXPECT_LT(now_s, 1.8 * then_s);
  expect_within({.rmse_m = 0.06, .anees = 6.0}, drive.online());
  expect_within({.rmse_m = 0.09, .anees = 5.8}, drive.hindsight());
}

TEST(LongDrive, HundredsOfPriorsDoNotBendIt) {
  // GIVEN a drive along the wall of a large hall, where all landmarks are initialised at the edge of the view
  HindsightDrive drive(large_hall(6, 3.2), keeping(1500));
  while (to_seconds(drive.next()) < 190.0) drive.hear_s();
  expect_within({.rmse_m = 0.2, .anees = 2.4}, drive.online());
  expect_within({.rmse_m = 0.13, .anees = 2.8}, drive.hindsight());
}

}  // namespace
}  // namespace azimuth
