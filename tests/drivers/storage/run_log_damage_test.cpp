// Logs without a run, or with an incomplete one.

#include <algorithm>
#include <gmock/gmock.h>
#include <random>

#include "tests/drivers/storage/log_text.hpp"
#include "tests/drivers/storage/samples.hpp"
#include "tests/support/data.hpp"

namespace azimuth {
namespace {

using test::Buffer;
using test::collect;
using test::LogText;
using ::testing::HasSubstr;

TEST(RunLog, EmptyRunsAreErrors) {
  EXPECT_THAT(text(collect(LogText().rig().bearings(0).bytes()).error()),
              HasSubstr("holds no usable message on AZIMUTH_ODOM"));
  EXPECT_THAT(text(collect(LogText().rig().odometry(0).add("X", Buffer(1)).bytes()).error()),
              HasSubstr("holds no usable message on AZIMUTH_BEARINGS (skipped: 1 events on foreign channels)"));
}

TEST(RunLog, OtherFilesAreNoLogs) {
  const test::TemporaryFolder folder;
  for (const std::string content : {"", "t_s,x_m,y_m,heading_rad\n0,0,0,0\n"}) {
    test::write(folder / "odometry.csv", content);
    EXPECT_EQ(text(load_run(folder / "odometry.csv").error()),
              (folder / "odometry.csv").string() + ": is not an LCM log: it holds no whole event\n");
  }
}

TEST(RunLog, LogOfOthersIsAClearError) {
  AZIMUTH_REQUIRE_DATA("lcm-example/example.lcmlog");
  const auto run = load_run(test::data_folder() / "lcm-example/example.lcmlog");
  ASSERT_FALSE(run);
  EXPECT_THAT(text(run.error()), HasSubstr("holds no usable message on AZIMUTH_ODOM (skipped: 10 events on foreign"));
}

TEST(RunLog, CutAnywhereReplaysUpToTheLastWholeEvent) {
  const test::TemporaryFolder folder;
  const azimuth::Run whole = test::example_run(5);
  ASSERT_TRUE(write_run_log(whole, folder / "a.lcm"));
  const std::string log = test::read(folder / "a.lcm");
  std::size_t records = 0;
  for (std::size_t cut = 0; cut <= log.size(); ++cut) {
    const auto run = collect(std::as_bytes(std::span(log)).first(cut));
    if (!run) continue;
    const std::size_t now = run->odometry.size() + run->bearings.size() + run->truth.size();
    EXPECT_GE(now, records) << "cut at " << cut;
    records = now;
    ASSERT_TRUE(test::same_bits(
        run->odometry,
        {whole.odometry.begin(), whole.odometry.begin() + static_cast<std::ptrdiff_t>(run->odometry.size())}));
  }
  EXPECT_EQ(records, 15U);
}

TEST(RunLog, DamageNeverYieldsUnsoundRuns) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(write_run_log(test::example_run(5), folder / "a.lcm"));
  const std::string log = test::read(folder / "a.lcm");
  std::mt19937_64 bits(11);
  for (int round = 0; round < 20'000; ++round) {
    std::string damaged = log;
    for (auto changes = 1 + bits() % 10; changes-- > 0;) damaged[bits() % damaged.size()] = static_cast<char>(bits());
    const auto run = collect(std::as_bytes(std::span(std::as_const(damaged))));
    if (!run) continue;
    ASSERT_FALSE(run->odometry.empty());
    ASSERT_TRUE(std::ranges::is_sorted(run->odometry, std::less{}, &OdometryReading::stamp));
    ASSERT_TRUE(std::ranges::is_sorted(run->bearings, std::less{}, &BearingSet::stamp));
  }
}

}  // namespace
}  // namespace azimuth
