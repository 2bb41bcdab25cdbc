// Robots that differ from their rig and violate the estimators' assumptions: the smoother must trust its observations
// more than the rig.

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "settings/configured_estimator.hpp"
#include "settings/sample_sentence.hpp"
#include "tests/scenarios/replayed.hpp"
#include "tests/support/data.hpp"
#include "tests/support/encoder_robot.hpp"
#include "tools/replay/replay_record.hpp"

namespace azimuth {
namespace {

using testing::HasSubstr;

constexpr int kSeeds = 20;

struct Judged {
  Report report;
  SampleFinding finding;
};

Judged judged(const Run& run, const Rig& rig) {
  const ReplayResult result = replay(run, rig, configured_estimator(rig, {}), StageSettings{});
  return {evaluate(replay_record(run, rig, "smoother", 0, result)), result.samples};
}

Judged judged(EncoderRobot robot, std::uint64_t seed) {
  robot.seed = seed;
  const Run run = driven(robot);
  return judged(run, rig_of(run));
}

struct Together {
  double rmse_m = 0.0, anees = 0.0, worst = 0.0, hindsight_anees = 0.0, bearing_noise = 0.0, odometry_noise = 0.0;
  int with_sentence = 0, doubted = 0;
};

Together of_several(const EncoderRobot& robot, const std::string& title, int seeds = kSeeds) {
  Together all;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto [report, finding] = judged(robot, static_cast<std::uint64_t>(seed));
    const double anees = report.tracking_consistency.anees;
    all.rmse_m += report.position_m.rmse / seeds;
    all.anees += anees / seeds;
    all.worst = std::max(all.worst, anees);
    all.hindsight_anees += report.hindsight->consistency.anees / seeds;
    all.bearing_noise += std::log(finding.rig.bearing_noise) / seeds;
    all.odometry_noise += std::log(finding.rig.odometry_noise) / seeds;
    all.with_sentence += sentence(finding).empty() ? 0 : 1;
    all.doubted += finding.rig.contradicts() ? 1 : 0;
  }
  all.bearing_noise = std::exp(all.bearing_noise);
  all.odometry_noise = std::exp(all.odometry_noise);
  fmt::print(
      "{:<44} rmse {:.3f} m, ANEES while tracking {:.1f} (worst {:.1f}), in hindsight {:.1f}; bearings {:.2f}, "
      "odometry "
      "{:.2f} times as noisy; contradicted {} of {}, said {} of {}\n",
      title, all.rmse_m, all.anees, all.worst, all.hindsight_anees, all.bearing_noise, all.odometry_noise, all.doubted,
      seeds, all.with_sentence, seeds);
  return all;
}

TEST(WrongRigs, OfTwentyRobotsAsTheRigSaysNothingIsSaid) {
  const Together all = of_several({}, "as the rig says");
  EXPECT_LE(all.with_sentence, 1);
  EXPECT_LE(all.anees, 5.0);
}

TEST(WrongRigs, BearingsAreAsNoisyAsTheyAre) {
  for (const double noise : {0.3, 0.5, 2.0, 3.0, 4.0}) {
    const Together all = of_several({.bearing_noise = noise}, fmt::format("bearings {} times as noisy", noise));
    EXPECT_LE(all.anees, 5.0) << noise;
    if (noise < 1.0) continue;
    EXPECT_NEAR(std::log(all.bearing_noise), std::log(noise), std::log(1.15)) << noise;
    EXPECT_GE(all.with_sentence, kSeeds - 1) << noise;
  }
}

// Slips last a second or two and do not fit the noise model of the rig's lambdas; the test checks the covariances.
TEST(WrongRigs, OdometryThatIsNoisierIsCovered) {
  for (const double noise : {0.3, 0.5, 2.0, 4.0}) {
    const Together all = of_several({.odometry_noise = noise}, fmt::format("odometry {} times as noisy", noise));
    EXPECT_LE(all.anees, 5.0) << noise;
    if (noise > 3.0) {
      EXPECT_GE(all.odometry_noise, 1.5) << noise;
      EXPECT_GE(all.with_sentence, kSeeds - 1) << noise;
    }
  }
}

TEST(WrongRigs, ACameraAskewIsFoundOut) {
  for (const double yaw_rad : {0.05, 0.08, -0.12}) {
    const Together all = of_several({.camera_yaw_rad = yaw_rad}, fmt::format("a camera askew by {} rad", yaw_rad));
    EXPECT_LE(all.anees, 6.0) << yaw_rad;
    EXPECT_GE(all.doubted, kSeeds - 1) << yaw_rad;
  }
}

TEST(WrongRigs, OfTwentyRobotsWithoutNamesAsTheRigSaysNothingIsSaid) {
  const Together all = of_several({.names = false}, "as the rig says, without names");
  EXPECT_EQ(all.doubted, 0);
  EXPECT_LE(all.worst, 5.0);
}

TEST(WrongRigs, ACameraAskewIsFoundOutWithoutNames) {
  const Together all =
      of_several({.camera_yaw_rad = 0.08, .names = false}, "a camera askew by 0.08 rad, without names");
  EXPECT_LE(all.worst, 6.0) << "also on drives that do not tell";
  EXPECT_GE(all.doubted, kSeeds - 3);
}

// Without names a wrong value is found once enough of the map is right in spite of it. Where that never happens, the
// map is known to be in doubt. Each drive takes ten seconds.
void expect_found_without_names(const EncoderRobot& robot, const std::string& title, int least_doubted) {
  const Together all = of_several(robot, title + ", without names", 10);
  EXPECT_LE(all.anees, 6.0) << title;
  EXPECT_GE(all.doubted, least_doubted) << title;
}

TEST(WrongRigs, TurnsThatAreNotAsReportedAreFoundOutWithoutNames) {
  expect_found_without_names({.scale_turn = 1.35, .names = false}, "turns 1.35 times what they are", 8);
}

TEST(WrongRigs, ADriftIsFoundOutWithoutNames) {
  expect_found_without_names({.drift_rad_per_m = 0.04, .names = false}, "a drift of 0.04 rad/m", 8);
}

TEST(WrongRigs, LateImagesAreFoundOutWithoutNames) {
  expect_found_without_names({.image_lag_s = 0.2, .names = false}, "images 0.2 s late", 5);
}

TEST(WrongRigs, ACameraThatStandsElsewhereIsFoundOutWithoutNames) {
  expect_found_without_names({.p_body_camera_m = {0.3, -0.12}, .names = false}, "a camera 0.3 m ahead", 4);
}

// A real laser that was mounted 4.6 degrees askew.
TEST(LostInTheWoods, IsTrackedWithNamesAndWithout) {
  AZIMUTH_REQUIRE_DATA("lostwoods-c");
  const auto run = load_run(test::data_folder() / "lostwoods-c");
  ASSERT_TRUE(run) << text(run.error());
  for (const bool names : {true, false}) {
    Rig rig = rig_of(*run);
    rig.camera.identities = names;
    const auto [report, finding] = judged(*run, rig);
    fmt::print("lostwoods-c, {}: rmse {:.3f} m, ANEES while tracking {:.2f}\n", names ? "names" : "no names",
               report.position_m.rmse, report.tracking_consistency.anees);
    EXPECT_LE(report.position_m.rmse, 0.06);
    EXPECT_LE(report.tracking_consistency.anees, 6.0);
    EXPECT_TRUE(finding.rig.yaw_offset_rad.has_value());
  }
}

TEST(WrongRigs, TurnsThatAreNotAsReportedAreFoundOut) {
  for (const double scale : {0.8, 1.35}) {
    const Together all = of_several({.scale_turn = scale}, fmt::format("turns {} times what they are", scale));
    EXPECT_LE(all.anees, 6.0) << scale;
    EXPECT_GE(all.doubted, kSeeds - 1) << scale;
  }
}

TEST(WrongRigs, LateImagesAreFoundOut) {
  for (const double lag_s : {0.1, 0.2}) {
    const Together all = of_several({.image_lag_s = lag_s}, fmt::format("images {} s late", lag_s));
    EXPECT_LE(all.anees, 6.0) << lag_s;
    EXPECT_GE(all.with_sentence, lag_s > 0.15 ? kSeeds - 1 : kSeeds / 2) << lag_s;
  }
}

TEST(WrongRigs, ACameraThatStandsElsewhereIsFoundOut) {
  for (const double ahead_m : {0.1, 0.3, 0.5}) {
    const Together all =
        of_several({.p_body_camera_m = {ahead_m, -0.4 * ahead_m}}, fmt::format("a camera {} m ahead", ahead_m));
    EXPECT_LE(all.anees, 6.0) << ahead_m;
    EXPECT_GE(all.doubted, kSeeds - 1) << ahead_m;
  }
}

TEST(WrongRigs, AnOdometerThatCreepsIsFoundOut) {
  for (const double m_per_s : {0.005, 0.02, 0.05}) {
    const Together all = of_several({.laps = 1, .stands_s = 50.0, .creeps_m_per_s = m_per_s},
                                    fmt::format("stands 50 s and creeps by {} m/s", m_per_s));
    EXPECT_LE(all.anees, 6.0) << m_per_s;
    EXPECT_GE(all.with_sentence, m_per_s > 0.01 ? kSeeds - 1 : kSeeds / 2) << m_per_s;
  }
}

TEST(WrongRig, IsNamedWithTheValueThatFits) {
  EXPECT_THAT(sentence(judged({.camera_yaw_rad = 0.08}, 1).finding), HasSubstr("camera.yaw_offset_rad = 0.0"));
  EXPECT_THAT(sentence(judged({.bearing_noise = 3.0}, 1).finding), HasSubstr("camera.sigma_bearing_rad says"));
  EXPECT_EQ(sentence(judged({}, 1).finding), "");
}

}  // namespace
}  // namespace azimuth
