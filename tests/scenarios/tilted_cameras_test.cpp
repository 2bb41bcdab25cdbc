// A tilted mirror and coloured landmarks in the lab. The rig states the tilt or declares it unknown.

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vector>

#include "slam/geometry/angle.hpp"
#include "tests/scenarios/replayed.hpp"
#include "tests/support/rendered_drive.hpp"

namespace azimuth {
namespace {

constexpr int kSeeds = 4;
constexpr double kDriven_s = 60.0;

RenderSettings leaning(double tilt_deg, std::uint64_t seed) {
  const double tilt_rad = degrees_to_rad(tilt_deg), way_rad = 2.4 * static_cast<double>(seed);
  RenderSettings settings{.size = 0.75};
  settings.roll_rad = tilt_rad * std::cos(way_rad);
  settings.pitch_rad = tilt_rad * std::sin(way_rad);
  return settings;
}

struct Driven {
  Runs known, unknown;  ///< with a rig that states the tilt, and with one that declares it unmeasured
};

Driven driven(double tilt_deg) {
  Driven result;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const test::RenderedDrive drive(lab(seed), leaning(tilt_deg, seed), kDriven_s);
    Rig rig = drive.rig();
    result.known.reports.push_back(replayed(drive.seen_by(rig), rig));
    rig.camera.roll_rad = rig.camera.pitch_rad = 0.0;
    rig.camera.sigma_tilt_rad = 0.02;
    result.unknown.reports.push_back(replayed(drive.seen_by(rig), rig));
  }
  result.known.print(fmt::format("lab, mirror tilted by {} degrees, known", tilt_deg));
  result.unknown.print(fmt::format("lab, mirror tilted by {} degrees, unknown", tilt_deg));
  return result;
}

double rmse_m(const Runs& runs) {
  return runs.mean_of([](const Report& report) { return report.position_m.rmse; });
}

/// For a level mirror, a rig without knowledge of the tilt must cost hardly any accuracy.
TEST(TiltedMirrors, CostNothingIfTheyAreLevel) {
  Runs exact, open;
  for (std::uint64_t seed = 1; seed <= 2 * kSeeds; ++seed) {
    const test::RenderedDrive drive(lab(seed), leaning(0.0, seed), kDriven_s);
    Rig rig = drive.rig();
    const azimuth::Run run = drive.seen_by(rig);
    rig.camera.sigma_tilt_rad = 0.02;
    open.reports.push_back(replayed(run, rig));
    rig.camera.sigma_tilt_rad = 0.0;
    exact.reports.push_back(replayed(run, rig));
  }
  exact.print("lab, level mirror, known to be");
  open.print("lab, level mirror, as far as anybody knows");
  EXPECT_LE(rmse_m(open), 1.03 * rmse_m(exact));
}

TEST(TiltedMirrors, AreAsGoodAsLevelOnesIfTheRigSaysSo) {
  const double level_m = rmse_m(driven(0.0).known);
  for (const double tilt_deg : {1.0, 2.0}) {
    const Driven tilted = driven(tilt_deg);
    EXPECT_LE(rmse_m(tilted.known), 1.1 * level_m) << tilt_deg;
    for (const Report& report : tilted.unknown.reports) {
      EXPECT_LE(report.tracking_consistency.anees, 6.0) << tilt_deg;
      EXPECT_EQ(report.health_over_time.times_lost, 0U) << tilt_deg;
    }
  }
}

}  // namespace
}  // namespace azimuth
