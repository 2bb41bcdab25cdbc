// Accuracy that FastSLAM and the lamp EKF must reach on a run that is not shipped: images of an upward camera in a hall
// with lamps and windows, ray-traced by another renderer.

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "slam/camera/camera_tilt.hpp"
#include "slam/ceiling/make_lamp_ekf_estimator.hpp"
#include "slam/geometry/angle.hpp"
#include "slam/particles/make_fastslam_estimator.hpp"
#include "slam/perception/make_perception.hpp"
#include "tests/geometry/random_draws.hpp"
#include "tests/scenarios/replayed.hpp"
#include "tests/support/data.hpp"
#include "tests/support/spoilt_perception.hpp"
#include "tools/replay/replay.hpp"
#include "tools/replay/replay_record.hpp"
#include "tools/replay/set_source.hpp"

namespace azimuth {
namespace {

constexpr const char* kHall = "hall-a";
constexpr int kSide_px = 768;

using test::Spoil;
using test::SpoiltPerception;

void leave(const FrameFormat&, std::vector<std::byte>&, int) {}

void switch_off(const FrameFormat&, std::vector<std::byte>& pixels, int image) {
  if (image >= 150 && image < 200) std::ranges::fill(pixels, std::byte{3});
}

/// From the middle of the run on, hundreds of spots as bright as lamps at random places.
void glitter(const FrameFormat&, std::vector<std::byte>& pixels, int image) {
  if (image < 160) return;
  RandomDraws draws(static_cast<unsigned>(image));
  for (int spot = 0; spot < 300; ++spot) {
    const int u = static_cast<int>(draws.uniform(0, kSide_px - 4)),
              v = static_cast<int>(draws.uniform(0, kSide_px - 4));
    for (int k = 0; k < 16; ++k) pixels[static_cast<std::size_t>((v + k / 4) * kSide_px + u + k % 4)] = std::byte{255};
  }
}

class Hall : public testing::Test {
 protected:
  void SetUp() override { AZIMUTH_REQUIRE_DATA(kHall); }

  static Rig rig_with(const azimuth::Run& run, const CameraTilt& told) {
    Rig rig = rig_of(run);
    rig.camera.roll_rad = told.roll_rad;
    rig.camera.pitch_rad = told.pitch_rad;
    return rig;
  }

  /// The run with bearings that the front end detects in its images, for a rig with the tilt `told`.
  static azimuth::Run looked_at(const Spoil& spoil = leave, const CameraTilt& told = {}) {
    azimuth::Run run = *load_run(test::data_folder() / kHall);
    const Rig rig = rig_with(run, told);
    SeenSets sets(run, rig.camera.image,
                  {std::make_unique<SpoiltPerception>(make_perception(FrontEnd::lamps, rig.camera, {}), spoil),
                   decoded_format(FrontEnd::lamps)});
    std::vector<BearingSet> seen(sets.count());
    for (BearingSet& set : seen) EXPECT_TRUE(sets.next(set));
    run.frames.clear();
    run.bearings = std::move(seen);
    return run;
  }

  static Report fastslam(const azimuth::Run& run, int seed, FastSlamSettings settings = {}) {
    settings.seed = seed;
    const Rig rig = rig_of(run);
    const ReplayResult result = replay(run, rig, make_fastslam_estimator(rig, settings), StageSettings{});
    const Report report = evaluate(replay_record(run, rig, "fastslam", 0, result));
    fmt::print(
        "seed {}: rmse {:.3f} m, max {:.3f} m, ANEES {:.2f}, {} landmarks, {} of {} lamps, {:.3f} m off in space; {}\n",
        seed, report.position_m.rmse, report.position_m.max, report.consistency.anees, report.map.landmarks,
        report.space_map.matched, report.space_map.true_landmarks, report.space_map.position_m.mean, report.health);
    return report;
  }

  static Report lamp_ekf(const azimuth::Run& run, const CameraTilt& told = {}) {
    const Rig rig = rig_with(run, told);
    const ReplayResult result = replay(run, rig, make_lamp_ekf_estimator(rig, {}), StageSettings{});
    const Report report = evaluate(replay_record(run, rig, "lamp_ekf", 0, result));
    fmt::print(
        "lamp EKF: mean {:.3f} m, max {:.3f} m, ANEES {:.2f}, {} landmarks, {} of {} lamps, {:.3f} m off in space; "
        "{}\n",
        report.position_m.mean, report.position_m.max, report.consistency.anees, report.map.landmarks,
        report.space_map.matched, report.space_map.true_landmarks, report.space_map.position_m.mean, report.health);
    return report;
  }
};

// One lamp never rises above the elevation from which on the lamp EKF uses lamps.
constexpr std::size_t kTooLow = 1;

TEST_F(Hall, TheLampEkfMapsEveryLampOnceAndNoWindow) {
  const Report report = lamp_ekf(looked_at());
  EXPECT_LE(report.position_m.mean, 0.09);
  EXPECT_GE(report.space_map.matched + kTooLow, report.space_map.true_landmarks);
  EXPECT_EQ(report.map.landmarks, report.map.matched) << "an estimate that is of no lamp";
  EXPECT_EQ(report.map.duplicates, 0u);
  EXPECT_EQ(report.health, "tracking");
}

/// The camera is level, but the rig states a tilt.
TEST_F(Hall, TheLampEkfFindsHowTheCameraLeans) {
  const double level_m = lamp_ekf(looked_at()).position_m.rmse;
  for (const double tilt_deg : {1.0, 2.0}) {
    for (const double way_rad : {0.0, 1.6, 2.4}) {
      const double tilt_rad = degrees_to_rad(tilt_deg);
      const CameraTilt told{tilt_rad * std::cos(way_rad), tilt_rad * std::sin(way_rad)};
      const Report report = lamp_ekf(looked_at(leave, told), told);
      EXPECT_LE(report.position_m.rmse, 1.1 * level_m) << tilt_deg << ' ' << way_rad;
      EXPECT_LE(report.consistency.anees, 6.0) << "1000 when the rig is believed";
      EXPECT_EQ(report.health_over_time.times_lost, 0U);
      EXPECT_EQ(report.health, "degraded") << "the rig should be calibrated anew";
    }
  }
}

TEST_F(Hall, TheLampEkfSurvivesDarkness) {
  const Report report = lamp_ekf(looked_at(switch_off));
  EXPECT_LE(report.position_m.mean, 0.11);
  EXPECT_GE(report.space_map.matched + kTooLow, report.space_map.true_landmarks) << "a lamp that is off is not gone";
  EXPECT_EQ(report.map.landmarks, report.map.matched);
  EXPECT_EQ(report.health, "tracking");
}

TEST_F(Hall, EveryLampIsMappedOnceAndNoWindow) {
  const azimuth::Run run = looked_at();
  for (int seed = 1; seed <= 6; ++seed) {
    const Report report = fastslam(run, seed);
    EXPECT_LE(report.position_m.rmse, 0.5);
    EXPECT_EQ(report.space_map.matched, report.space_map.true_landmarks) << "all of them were seen";
    EXPECT_EQ(report.map.landmarks, report.map.matched) << "an estimate that is of no lamp";
    EXPECT_EQ(report.map.duplicates, 0u);
    EXPECT_LE(report.space_map.position_m.mean, 0.48) << "the paper's";
    EXPECT_LE(report.consistency.anees, 10.0);
    EXPECT_GE(report.consistency.anees, 0.5);
    EXPECT_LE(report.two_sigma_final.x(), 1.2) << "1.7 times what odometry alone is off by";
    EXPECT_EQ(report.health, "tracking");
  }
}

TEST_F(Hall, ThePapersWayWorksAsTheyReport) {
  const azimuth::Run run = looked_at();
  for (int seed = 1; seed <= 3; ++seed) {
    const Report report = fastslam(run, seed, paper_fastslam_preset());
    EXPECT_LE(report.position_m.rmse, 0.5);
    EXPECT_GE(report.space_map.matched, 10u) << "it mapped 10 of 14";
    EXPECT_LE(report.space_map.position_m.mean, 0.48);
  }
}

/// The lamps are off for 13 m, where only odometry is available; afterwards the known lamps are recognised.
TEST_F(Hall, DarknessIsSurvived) {
  const Report report = fastslam(looked_at(switch_off), 1);
  EXPECT_LT(report.position_m.rmse, report.odometry_m.rmse);
  EXPECT_EQ(report.map.landmarks, report.map.matched);
  EXPECT_EQ(report.health, "degraded") << "the pose is off by more than half a metre, and known to be";
  EXPECT_LE(report.consistency.anees, 10.0);
}

TEST_F(Hall, GlitterDoesNotHideTheLamps) {
  const Report report = fastslam(looked_at(glitter), 1);
  EXPECT_LE(report.position_m.rmse, 0.5);
  EXPECT_EQ(report.space_map.matched, report.space_map.true_landmarks);
  EXPECT_EQ(report.health, "tracking");
}

}  // namespace
}  // namespace azimuth
