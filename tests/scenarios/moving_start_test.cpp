// The daemon starts while the robot drives: the camera delivers first, and odometry starts in the middle of a curve.

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <vector>

#include "drivers/storage/run.hpp"
#include "tests/scenarios/replayed.hpp"
#include "tests/support/places.hpp"

namespace azimuth {
namespace {

constexpr int kStarts = 20;
constexpr Duration kEarly = std::chrono::milliseconds(500);  // lead of the camera over the odometer
constexpr Duration kDrive = std::chrono::seconds(30);

/// The part of a run that such a daemon receives.
Run started_at(const Run& whole, Stamp start) {
  Run run = whole;
  const auto keep = [&](auto& samples, Duration before) {
    std::erase_if(samples, [&](const auto& s) { return s.stamp < start - before || s.stamp > start + kDrive; });
  };
  keep(run.odometry, Duration{0});
  keep(run.bearings, kEarly);
  keep(run.truth, std::chrono::seconds(1));
  return run;
}

double refused_share(const Report& report) {
  const auto& counts = report.association;
  return static_cast<double>(counts.rejected) / static_cast<double>(counts.accepted + counts.rejected);
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

TEST(MovingStart, IsAsHonestAsAnyOther) {
  // GIVEN a drive round the lab, and twenty instants at which the daemon starts
  const FileResult<azimuth::Run> whole = load_run(test::source_folder() / "runs/lab");
  ASSERT_TRUE(whole) << text(whole.error());
  // WHEN each start is followed for half a minute
  std::vector<double> anees, refused;
  for (int start = 0; start < kStarts; ++start) {
    const Report report =
        replayed(started_at(*whole, whole->odometry.front().stamp + (4 + 8 * start) * Duration(1'000'000)));
    anees.push_back(report.consistency.anees);
    refused.push_back(refused_share(report));
    EXPECT_EQ(report.health, "tracking") << "start " << start;
  }
  const double worst_anees = *std::ranges::max_element(anees), most_refused = *std::ranges::max_element(refused);
  fmt::print(
      "{} moving starts: ANEES {:.2f} (median), {:.2f} at worst; bearings refused: {:.1f} %, {:.1f} % at worst\n",
      kStarts, median(anees), worst_anees, 100.0 * median(refused), 100.0 * most_refused);
  // THEN the covariances are consistent with the pose errors
  EXPECT_LE(median(anees), 4.0);
  EXPECT_LE(worst_anees, 10.0);
  EXPECT_LE(most_refused, 0.2);
}

}  // namespace
}  // namespace azimuth
