// A mirror camera's images of an office, ray-traced by others and not shipped: what the image front ends must reach.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <utility>

#include "slam/estimator/make_estimator.hpp"
#include "slam/perception/make_perception.hpp"
#include "tests/scenarios/replayed.hpp"
#include "tests/support/data.hpp"
#include "tools/replay/replay.hpp"
#include "tools/replay/replay_record.hpp"
#include "tools/replay/set_source.hpp"

namespace azimuth {
namespace {

constexpr const char* kOffice = "office-a";

class Office : public testing::Test {
 protected:
  void SetUp() override { AZIMUTH_REQUIRE_DATA(kOffice); }

  /// The report of a replay with this front end; the image's centre is off by `knocked_px` along u.
  static Report looked_at(FrontEnd front_end, const EkfSettings& settings = {}, double knocked_px = 0.0) {
    const auto run = load_run(test::data_folder() / kOffice);
    Rig rig = rig_of(*run);
    rig.front_end = front_end;
    rig.camera.image.centre_px->at(0) += knocked_px;
    ImageFrontEnd images{make_perception(front_end, rig.camera, {}), decoded_format(front_end)};
    const ReplayResult result =
        replay_images(*run, rig, std::move(images), make_ekf_estimator(rig, settings), StageSettings{});
    const Report report = evaluate(replay_record(*run, rig, "ekf", 0, result));
    fmt::print("rmse {:.3f} m, max {:.3f} m, ANEES {:.2f}; odometry alone {:.3f} m; wrong {} of {} bearings; {}\n",
               report.position_m.rmse, report.position_m.max, report.consistency.anees, report.odometry_m.rmse,
               report.association.sightings.wrong, report.association.sightings.judged, report.health);
    return report;
  }

  static Report with_features(FeatureValidation validation) {
    EkfSettings settings;
    settings.identity.validation = validation;
    return looked_at(FrontEnd::sift, settings);
  }

  static void expect_right_identities(const Report& report) {
    EXPECT_GT(report.association.sightings.judged, report.association.accepted / 2);
    EXPECT_LT(report.association.sightings.wrong, report.association.sightings.judged / 100);
  }

  static void expect_consistent(const Report& report) {
    EXPECT_GE(report.consistency.anees, 1.5);
    EXPECT_LE(report.consistency.anees, 6.0);
  }
};

TEST_F(Office, CylindersAreMappedByColour) {
  const Report report = looked_at(FrontEnd::colour);
  EXPECT_LE(report.position_m.rmse, 0.12);
  EXPECT_GE(report.map.matched, 12u);
  EXPECT_LE(report.map.position_m.mean, 0.15);
  EXPECT_EQ(report.map.duplicates, 0u);
  expect_consistent(report);
}

TEST_F(Office, AKnockedMirrorIsNoticedAndAllowedFor) {
  const Report report = looked_at(FrontEnd::colour, {}, 10.0);
  EXPECT_LE(report.position_m.rmse, 0.12);
  EXPECT_LE(report.consistency.anees, 30.0);  // of centimetres; 1500 when the rig is believed
  EXPECT_EQ(report.health, "degraded") << "the rig should be calibrated anew";
}

TEST_F(Office, FeaturesAreToldApartByGeometry) {
  const Report report = with_features(FeatureValidation::geometry);
  EXPECT_LE(report.position_m.rmse, 0.15);
  expect_right_identities(report);
  expect_consistent(report);
}

TEST_F(Office, FeaturesAreToldApartByPatterns) {
  const Report report = with_features(FeatureValidation::patterns);
  EXPECT_LE(report.position_m.rmse, 0.20);
  expect_right_identities(report);
  expect_consistent(report);
}

}  // namespace
}  // namespace azimuth
