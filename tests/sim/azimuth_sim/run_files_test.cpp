#include "sim/azimuth_sim/run_files.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <unistd.h>

#include "sim/world/run_of.hpp"

namespace azimuth::sim {
namespace {

namespace fs = std::filesystem;

constexpr Duration kEpoch{1'700'000'000'000'000};

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

class RunFilesTest : public testing::Test {
 public:
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }

  fs::path folder = fs::path(testing::TempDir()) / ("run_files_" + std::to_string(::getpid()));
  PacedClock clock{PacedClock::Monotonic::time_point(std::chrono::seconds(100)), kEpoch, 2.0};
};

TEST_F(RunFilesTest, TablesAreOnTheDaemonsClockAndWrittenAtOnce) {
  auto files = RunFiles::create({folder / "truth.csv", folder / "sip.csv", {}}, lab(1));
  ASSERT_TRUE(files);
  SimulationOutput output;
  output.truth.push_back({stamp_from_us(3'000'000), {1.25, -2.0, 0.5}});
  output.latches.push_back({stamp_from_us(1), {65535, 3, -2048}});
  files->add(output, clock);
  EXPECT_EQ(text_of(folder / "truth.csv"), "t_s,x_m,y_m,heading_rad\n1700000101.500000,1.25,-2,0.5\n");
  EXPECT_EQ(text_of(folder / "sip.csv"), "t_latch_s,x_raw,y_raw,heading_raw\n1700000100.000000,65535,3,-2048\n");
  EXPECT_TRUE(files->finish());
}

TEST_F(RunFilesTest, TheFolderIsARunThatCanBeLoaded) {
  const Scenario scenario = lab(3, 1);
  auto files = RunFiles::create({{}, {}, folder / "run"}, scenario);
  ASSERT_TRUE(files);
  EXPECT_EQ(text_of(folder / "run" / "rig.toml"), rig_toml(scenario)) << "from the start";
  Simulation simulation({scenario, PioneerModel{}, {}, std::nullopt});
  for (int second = 1; second <= 20; ++second) {
    SimulationOutput output;
    simulation.advance(stamp_from_us(1'000'000 * second), output);
    files->add(output, clock);
  }
  ASSERT_TRUE(files->finish());
  const auto run = load_run(folder / "run");
  ASSERT_TRUE(run) << text(run.error());
  EXPECT_EQ(run->odometry.size(), 201U);
  EXPECT_EQ(run->truth.size(), 2001U);
  EXPECT_EQ(run->bearings.size(), 100U);
  EXPECT_EQ(run->landmarks.size(), scenario.landmarks.size());
  EXPECT_EQ(run->truth.back().stamp, Stamp(std::chrono::seconds(110)) + kEpoch);
}

TEST_F(RunFilesTest, NamesWhatCannotBeWritten) {
  const auto files = RunFiles::create({folder / "missing" / "truth.csv", {}, {}}, lab(1));
  ASSERT_FALSE(files);
  EXPECT_NE(text(files.error()).find("truth.csv"), std::string::npos);
}

}  // namespace
}  // namespace azimuth::sim
