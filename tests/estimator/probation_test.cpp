// Landmarks on probation. Images may show clutter, so the EKF uses a new landmark at once, but publishes it only after
// enough sightings.

#include <cmath>
#include <gtest/gtest.h>

#include "slam/planar/ekf_estimator.hpp"
#include "tests/support/stamps.hpp"

namespace azimuth {
namespace {

constexpr int kSightings = 8;  // default number of sightings that ends the probation of landmarks from images
constexpr Kind kRed = 1;

Rig rig_seeing(FrontEnd front_end, bool names = false) {
  Rig rig;
  rig.front_end = front_end;
  rig.camera.identities = names;
  return rig;
}

Bearing bearing_to(const Eigen::Vector2d& p_map_m, const Eigen::Vector2d& p_map_robot_m, bool name) {
  const Eigen::Vector2d d = p_map_m - p_map_robot_m;
  return {.azimuth_rad = std::atan2(d.y(), d.x()),
          .identity = name ? 7 : kUnknownIdentity,
          .kind = kRed,
          .sigma_rad = 0.005,
          .radius_px = 250.0};
}

Motion half_metre() {
  Motion motion{.T_start_end = {0.5, 0.0, 0.0}, .path_m = 0.5};
  motion.covariance.diagonal() << 1e-4, 1e-4, 1e-5;
  return motion;
}

/// A robot that drives along x past a red landmark, half a metre and one image per second.
class Passing {
 public:
  explicit Passing(const Rig& rig, const EkfSettings& settings = {}, const MapStart& start = {})
      : rig_(rig), estimator_(rig_, settings, start) {}

  const Estimate& sees(bool it = true) {
    ++images_;
    if (images_ > 1) {
      x_m_ += 0.5;
      estimator_.predict(half_metre());
    }
    BearingSet set{.stamp = at_s(images_), .sequence = static_cast<std::uint64_t>(images_), .bearings = {}};
    if (it) set.bearings.push_back(bearing_to({2.0, 3.0}, {x_m_, 0.0}, rig_.camera.identities));
    estimator_.update(set);
    last_ = {};
    estimator_.estimate(last_);
    return last_;
  }
  EkfEstimator& estimator() { return estimator_; }

 private:
  Rig rig_;
  EkfEstimator estimator_;
  Estimate last_;
  int images_ = 0;
  double x_m_ = 0.0;
};

TEST(Probation, EndsWhenImagesHaveShownALandmarkOften) {
  Passing robot(rig_seeing(FrontEnd::colour));
  for (int i = 1; i < kSightings; ++i) {
    const Estimate& estimate = robot.sees();
    ASSERT_EQ(robot.estimator().landmarks().size(), 1u) << i;
    EXPECT_TRUE(estimate.landmarks.empty()) << i;
  }
  const Estimate& estimate = robot.sees();
  ASSERT_EQ(estimate.landmarks.size(), 1u);
  EXPECT_EQ(estimate.landmarks.front().id, robot.estimator().landmarks().front().id);
}

TEST(Probation, IsNoneWhereOneSightingIsEnough) {
  EkfSettings settings;
  settings.probation.confirm_after_sightings = 1;
  EXPECT_EQ(Passing(rig_seeing(FrontEnd::colour), settings).sees().landmarks.size(), 1u);
}

TEST(Probation, CountsWhatIsHeardOf) {
  Passing robot(rig_seeing(FrontEnd::colour));
  for (int i = 1; i < kSightings; ++i) EXPECT_EQ(robot.sees().association.created, 0u);
  EXPECT_EQ(robot.sees().association.created, 1u);

  Passing mistaken(rig_seeing(FrontEnd::colour));
  mistaken.sees();
  for (int i = 0; i < 10; ++i) EXPECT_EQ(mistaken.sees(false).association.deleted, 0u);
}

TEST(Probation, LandmarksServeThePoseMeanwhile) {
  Passing robot(rig_seeing(FrontEnd::colour));
  robot.sees();
  const Estimate& estimate = robot.sees();
  EXPECT_EQ(estimate.accepted.size(), 1u);
  EXPECT_EQ(estimate.health, Health::tracking);
}

TEST(Probation, IsNeverHeardOfWhenTheThingIsNotSeenAgain) {
  Passing robot(rig_seeing(FrontEnd::colour));
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(robot.sees().landmarks.empty());
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(robot.sees(false).landmarks.empty());
  EXPECT_TRUE(robot.estimator().landmarks().empty());
}

TEST(Probation, KeepsALandmarkOutOfASavedMap) {
  EkfSettings settings;
  settings.probation.confirm_after_sightings = 12;  // it is a point before that
  Passing robot(rig_seeing(FrontEnd::colour), settings);
  MapSnapshot map;
  for (int i = 1; i < 12; ++i) robot.sees();
  ASSERT_TRUE(robot.estimator().landmarks().front().is_point());
  EXPECT_FALSE(robot.estimator().save_map(map));
  robot.sees();
  ASSERT_TRUE(robot.estimator().save_map(map));
  EXPECT_EQ(map.landmarks.size(), 1u);
}

/// The sightings in a saved map do not count: a map from a version without probation may hold landmarks with few.
TEST(Probation, IsNotForTheLandmarksOfASavedMap) {
  Passing first(rig_seeing(FrontEnd::colour));
  MapSnapshot map;
  for (int i = 1; i <= kSightings; ++i) first.sees();
  ASSERT_TRUE(first.estimator().save_map(map));
  map.landmarks.front().sightings = 2;
  Passing again(rig_seeing(FrontEnd::colour), {}, {&map, MapMode::extend, true, 0.1, 0.1});
  Estimate estimate;
  again.estimator().estimate(estimate);
  EXPECT_EQ(estimate.landmarks.size(), 1u);
  EXPECT_TRUE(again.estimator().save_map(map));
}

TEST(Probation, IsNotForWhatHasANameOrComesReadyMade) {
  for (const Rig& rig : {rig_seeing(FrontEnd::colour, true), rig_seeing(FrontEnd::bearings)}) {
    EkfSettings settings;
    settings.initialisation = Initialisation::undelayed;
    EkfEstimator estimator(rig, settings);
    estimator.update(
        {.stamp = at_s(1), .sequence = 1, .bearings = {bearing_to({2.0, 3.0}, {0.0, 0.0}, rig.camera.identities)}});
    Estimate estimate;
    estimator.estimate(estimate);
    EXPECT_EQ(estimate.landmarks.size(), 1u);
  }
}

}  // namespace
}  // namespace azimuth
