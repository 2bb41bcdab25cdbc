// The lab runs without their names: what must be reached, live and in hindsight.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "settings/rig.hpp"
#include "tests/support/data.hpp"
#include "tests/support/nameless_run.hpp"

namespace azimuth {
namespace {

std::vector<EstimateRecord> odometry_alone(std::vector<EstimateRecord> records) {
  for (EstimateRecord& record : records) record.T_map_body = record.T_odom_body;
  return records;
}

TEST(NamelessOnRuns, LabRunsAreTwiceAsGoodAsOdometry) {
  AZIMUTH_REQUIRE_DATA("lab-runs");
  constexpr int kRuns = 20;
  RunError online, smoothed;
  double odometry_m = 0.0;
  int mapped = 0, duplicates = 0, worse = 0;
  for (int i = 0; i < kRuns; ++i) {
    const auto run = load_run(test::data_folder() / fmt::format("lab-runs/lab-{:03}", i));
    ASSERT_TRUE(run) << text(run.error());
    const Rig rig = *read_rig(run->rig_toml, run->rig_file);
    Scene scene;
    scene.sigma_bearing_rad = rig.camera.sigma_bearing_rad;
    InTurn workers;
    NamelessMapScore map;
    const NamelessRun result =
        nameless_run(*run, rig, nameless_settings_for(rig, scene, doubting_smoother()), workers, map);
    const RunError live = run_error(*run, result.online), hindsight = run_error(*run, result.smoothed);
    const double by_odometry_m = run_error(*run, odometry_alone(result.online)).rmse_m;
    online.rmse_m += live.rmse_m / kRuns;
    online.anees += live.anees / kRuns;
    smoothed.rmse_m += hindsight.rmse_m / kRuns;
    smoothed.anees += hindsight.anees / kRuns;
    odometry_m += by_odometry_m / kRuns;
    mapped += map.mapped;
    duplicates += map.duplicates;
    worse += live.rmse_m > by_odometry_m ? 1 : 0;
  }
  fmt::print(
      "odometry {:.3f} m  online {:.3f} m (ANEES {:.1f})  smoothed {:.3f} m ({:.1f})  mapped {} duplicates {} of {}\n",
      odometry_m, online.rmse_m, online.anees, smoothed.rmse_m, smoothed.anees, mapped, duplicates, 24 * kRuns);
  EXPECT_LE(online.rmse_m, 0.16);
  EXPECT_LE(online.anees, 5.0);
  EXPECT_LE(smoothed.rmse_m, 0.085);
  EXPECT_LE(smoothed.anees, 5.5);
  EXPECT_LE(worse, 4);
  EXPECT_GE(mapped, 19 * kRuns);
  EXPECT_LE(duplicates, kRuns / 2);
}

}  // namespace
}  // namespace azimuth
