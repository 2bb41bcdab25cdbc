// Coloured landmarks in images of a third of the usual width, as over a slow bus. Few landmarks are visible at a time,
// and none from afar. The images are older than their stamps, as for a USB camera.

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <vector>

#include "sim/world/scenario.hpp"
#include "slam/geometry/index.hpp"
#include "slam/geometry/random.hpp"
#include "slam/planar/make_ekf_estimator.hpp"
#include "tests/scenarios/replayed.hpp"
#include "tests/support/rendered_drive.hpp"
#include "tools/replay/replay.hpp"

namespace azimuth {
namespace {

using namespace std::chrono_literals;

constexpr double kDriven_s = 120.0;  // one and a half laps
constexpr Duration kLate = 60ms;

/// Value of AZIMUTH_SMALL_IMAGES, else 6.
int drives_asked() {
  const char* const asked = std::getenv("AZIMUTH_SMALL_IMAGES");
  return asked != nullptr ? std::max(1, std::atoi(asked)) : 6;
}

/// The run with the bearings from the images of a drive, without names.
azimuth::Run seen_in_small_images(std::uint64_t seed) {
  Scenario scenario = lab(seed);
  scenario.sampling.bearing_period_s = 0.25;
  return test::RenderedDrive(scenario, {.size = 0.3125, .quality = 95}, kDriven_s).seen();
}

azimuth::Run later(azimuth::Run run, Duration by) {
  for (BearingSet& set : run.bearings) set.stamp += by;
  return run;
}

/// A run without the samples that are lost while a cable is unplugged, at random the odometer's or the camera's.
struct CablesPulled {
  azimuth::Run run;
  std::vector<Stamp> odometer_back;
};
CablesPulled with_cables_pulled(azimuth::Run run, std::uint64_t seed) {
  constexpr double kFirst_s = 20.0, kLast_s = kDriven_s - 8.0;
  CablesPulled pulled;
  RandomNumbers<Xoshiro> chance{Xoshiro(seed)};
  for (double out_s = kFirst_s; out_s < kLast_s; out_s += chance.uniform(0.5, 1.3)) {
    const Stamp out(duration_from_seconds(out_s));
    out_s += chance.uniform(0.5, 1.8);
    const Stamp back(duration_from_seconds(out_s));
    const auto is_lost = [&](const auto& sample) { return sample.stamp >= out && sample.stamp < back; };
    if (chance.uniform() < 0.5) {
      std::erase_if(run.odometry, is_lost);
      pulled.odometer_back.push_back(back);
    } else {
      std::erase_if(run.bearings, is_lost);
    }
  }
  pulled.run = std::move(run);
  return pulled;
}

/// Time from each return of the odometer to the first step with health `tracking`; no value if none tracks.
std::vector<std::optional<double>> until_tracking_s(const CablesPulled& pulled, const ReplayResult& result) {
  std::vector<std::optional<double>> seconds;
  for (const Stamp back : pulled.odometer_back) {
    const auto tracks = std::ranges::find_if(result.healths, [back](const StepHealth& step) {
      return step.stamp >= back && step.health == Health::tracking;
    });
    seconds.push_back(tracks == result.healths.end() ? std::nullopt : std::optional(to_seconds(tracks->stamp - back)));
  }
  return seconds;
}

/// A single landmark that is not detected a few times in a row does not mean that the robot was carried off.
TEST(SmallImages, AreTrackedAgainWithinASecondOfAPulledCable) {
  const int drives = drives_asked();
  std::size_t pulls = 0;
  double worst_s = 0.0;
  for (std::uint64_t seed = 1; seed <= as_size(drives); ++seed) {
    SCOPED_TRACE(seed);
    const CablesPulled pulled = with_cables_pulled(later(seen_in_small_images(seed), kLate), seed);
    Rig rig = rig_of(pulled.run);
    rig.odometry.lag_s += to_seconds(kLate);
    const ReplayResult result = replay(pulled.run, rig, make_ekf_estimator(rig, EkfSettings{}), StageSettings{});
    for (const std::optional<double>& took_s : until_tracking_s(pulled, result)) {
      ++pulls;
      ASSERT_TRUE(took_s);
      worst_s = std::max(worst_s, *took_s);
    }
  }
  fmt::print("{} cables pulled, tracking {:.2f} s after the worst was back\n", pulls, worst_s);
  EXPECT_GE(pulls, 15 * as_size(drives));
  EXPECT_LE(worst_s, 1.0);
}

/// A robot with a correct pose is not lost because it sees fewer landmarks.
TEST(SmallImages, OfTheLabAreTrackedHoweverFewLandmarksTheyShow) {
  const int drives = drives_asked();
  double tracking = 0.0, late_tracking = 0.0, late_anees = 0.0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(drives); ++seed) {
    SCOPED_TRACE(seed);
    const azimuth::Run run = seen_in_small_images(seed);
    const Report on_time = replayed(run), late = replayed(later(run, kLate));
    for (const Report* report : {&on_time, &late})
      fmt::print(
          "seed {}{}: RMSE {:.3f} m, tracking {:.1f} %, lost {} times, ANEES {:.1f} while tracking, {} of {} mapped\n",
          seed, report == &late ? ", late" : "", report->position_m.rmse,
          100.0 * report->health_over_time.of(Health::tracking).share, report->health_over_time.times_lost,
          report->tracking_consistency.anees, report->map.matched, report->map.true_landmarks);
    EXPECT_EQ(on_time.health_over_time.times_lost, 0u);
    EXPECT_EQ(late.health_over_time.times_lost, 0u);
    EXPECT_LE(on_time.tracking_consistency.anees, 6.0);
    tracking += on_time.health_over_time.of(Health::tracking).share / drives;
    EXPECT_EQ(late.health, to_string(Health::degraded)) << "images and odometry are not of the same time";
    late_anees += late.tracking_consistency.anees / drives;
    late_tracking += late.health_over_time.of(Health::tracking).share / drives;
  }
  fmt::print("tracking {:.1f} %, late {:.1f} % (ANEES {:.1f})\n", 100.0 * tracking, 100.0 * late_tracking, late_anees);
  EXPECT_GE(tracking, 0.97);
  EXPECT_LE(late_tracking, 0.5);  // because the lag is uncertain at first
  EXPECT_LE(late_anees, 6.0);
}

}  // namespace
}  // namespace azimuth
