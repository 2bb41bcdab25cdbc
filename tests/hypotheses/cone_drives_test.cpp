// A small car that drives figures of eight fast among identical cones.

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "settings/rig.hpp"
#include "tests/support/cone_drive.hpp"
#include "tests/support/nameless_run.hpp"

namespace azimuth {
namespace {

constexpr int kSeeds = 20;

/// The share of live positions whose error is less than two standard deviations.
double share_within_two_sigma(const Run& run, const NamelessRun& result) {
  const auto errors = errors_of_each(run, result.online);
  double within = 0.0, all = 0.0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (!errors[i]) continue;
    const Eigen::Matrix3d& P = result.online[i].covariance;
    all += 1.0;
    within += errors[i]->head<2>().norm() <= 2.0 * std::sqrt(P(0, 0) + P(1, 1)) ? 1.0 : 0.0;
  }
  return within / all;
}

TEST(ConeDrives, EachConeIsOneLandmarkAndTheRobotKnowsWhereItIs) {
  int ten_at_most = 0, loops_closed = 0;
  double within = 0.0, worst_within = 1.0, online_m = 0.0, worst_m = 0.0, odometry_m = 0.0, worst_trusted_anees = 0.0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const azimuth::Run run = cone_drive(seed);
    const Rig rig = *read_rig(run.rig_toml, run.rig_file);
    InTurn workers;
    NamelessMapScore map;
    const NamelessRun result = nameless_run(run, rig, nameless_settings_for(rig), workers, map);
    EXPECT_EQ(map.mapped, 8);
    ten_at_most += map.landmarks <= 10 ? 1 : 0;
    const double error_m = run_error(run, result.online).rmse_m, share = share_within_two_sigma(run, result);
    const TrustScore trust = trust_score(run, result);
    loops_closed += run_error(run, result.smoothed).rmse_m < 0.2 * run_error(run, result.odometry).rmse_m ? 1 : 0;
    online_m += error_m / kSeeds;
    worst_m = std::max(worst_m, error_m);
    odometry_m += run_error(run, result.odometry).rmse_m / kSeeds;
    within += share / kSeeds;
    worst_within = std::min(worst_within, share);
    if (trust.share > 0.0) worst_trusted_anees = std::max(worst_trusted_anees, trust.anees);
  }
  fmt::print(
      "odometry {:.3f} m  online {:.3f} m, at worst {:.3f}  within 2 sigma {:.3f}, at worst {:.3f}  trusted ({:.1f})\n",
      odometry_m, online_m, worst_m, within, worst_within, worst_trusted_anees);
  fmt::print("ten landmarks at most in {}, loops closed in {} of {}\n", ten_at_most, loops_closed, kSeeds);
  EXPECT_EQ(ten_at_most, kSeeds);
  EXPECT_EQ(loops_closed, kSeeds);
  EXPECT_LE(online_m, 0.3);
  EXPECT_GE(within, 0.9);
  EXPECT_LE(worst_trusted_anees, 6.0);
}

}  // namespace
}  // namespace azimuth
