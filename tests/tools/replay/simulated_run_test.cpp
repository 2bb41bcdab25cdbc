#include "tools/simulated/simulated_run.hpp"

#include <gtest/gtest.h>

#include "settings/rig.hpp"
#include "sim/world/run_of.hpp"

namespace azimuth {
namespace {

TEST(SimulatedRun, RigSaysExactlyWhatWasSimulated) {
  Scenario scenario = corridor(1);
  scenario.odometer = {1e-3, 2e-3, 3e-3, 0.04, 0.97, 1.02, -0.01, 0.2};
  scenario.sensor.yaw_offset_rad = 0.1;
  scenario.sensor.identities = false;
  const FileResult<Rig> rig = read_rig(rig_toml(scenario), "rig.toml");
  ASSERT_TRUE(rig) << text(rig.error());
  EXPECT_EQ(rig->front_end, FrontEnd::bearings);
  EXPECT_EQ(rig->camera.sigma_bearing_rad, scenario.sensor.sigma_bearing_rad);
  EXPECT_EQ(rig->camera.field_of_view_rad, scenario.sensor.field_of_view_rad);
  EXPECT_EQ(rig->camera.yaw_offset_rad, 0.1);
  EXPECT_FALSE(rig->camera.identities);
  EXPECT_EQ(rig->odometry.lambda_distance_m, 1e-3);
  EXPECT_EQ(rig->odometry.lambda_rotation_rad, 2e-3);
  EXPECT_EQ(rig->odometry.lambda_drift_rad2_per_m, 3e-3);
  EXPECT_EQ(rig->odometry.sigma_lateral_m_per_sqrt_m, 0.04);
  EXPECT_EQ(rig->odometry.scale_distance, 0.97);
  EXPECT_EQ(rig->odometry.scale_turn, 1.02);
  EXPECT_EQ(rig->odometry.drift_rad_per_m, -0.01);
  EXPECT_EQ(rig->odometry.lag_s, 0.2);
}

TEST(SimulatedRun, HasEverythingARecordingHas) {
  for (const std::string_view name : kScenarioNames) {
    const azimuth::Run run = simulated_run(*scenario_named(name, 1));
    EXPECT_EQ(run.name, name);
    EXPECT_FALSE(run.odometry.empty() || run.bearings.empty() || run.truth.empty() || run.landmarks.empty());
    EXPECT_TRUE(read_rig(run.rig_toml, run.rig_file)) << name;
  }
}

}  // namespace
}  // namespace azimuth
