#include <gtest/gtest.h>

#include "tests/support/places.hpp"
#include "tests/tools/azimuth/command_line.hpp"

namespace azimuth::test {
namespace {

TEST(SimulateCommand, MakesTheShippedRunAgain) {
  const ScratchFolder scratch;
  const std::string run = scratch / "lab";
  ASSERT_EQ(azimuth({"simulate", run, "--world", "lab", "--seed", "11"}).code, 0);
  const auto made = folder_bytes(run), shipped = folder_bytes(test::source_folder() / "runs/lab");
  ASSERT_EQ(made.size(), shipped.size());
  std::size_t bytes = 0;
  for (const auto& [name, content] : shipped) {
    ASSERT_TRUE(made.contains(name)) << name;
    EXPECT_TRUE(made.at(name) == content) << name << " differs";
    bytes += content.size();
  }
  EXPECT_LT(bytes, 400000u);
}

TEST(SimulateCommand, EveryWorldReplays) {
  const ScratchFolder scratch;
  for (const char* world : {"coloured-lab", "lab", "hall", "corridor", "scattered"}) {
    const std::string run = scratch / world;
    ASSERT_EQ(azimuth({"simulate", run, "--world", world, "--laps", "1"}).code, 0) << world;
    EXPECT_EQ(digest_of(run).size(), 16u) << world;
  }
}

TEST(SimulateCommand, WritesALogByItsName) {
  const ScratchFolder scratch;
  const std::string folder = scratch / "run", log = scratch / "run.lcmlog";
  ASSERT_EQ(azimuth({"simulate", folder, "--world", "coloured-lab", "--seed", "3"}).code, 0);
  ASSERT_EQ(azimuth({"simulate", log, "--world", "coloured-lab", "--seed", "3"}).code, 0);
  EXPECT_EQ(digest_of(log), digest_of(folder));
}

TEST(SimulateCommand, HidesIdentities) {
  const ScratchFolder scratch;
  const std::string run = scratch / "run";
  ASSERT_EQ(azimuth({"simulate", run, "--world", "coloured-lab", "--no-identities", "--clutter", "0.5"}).code, 0);
  EXPECT_EQ(file_bytes(run + "/bearings.csv").find("landmark_id"), std::string::npos);
  EXPECT_NE(file_bytes(run + "/rig.toml").find("identities = false"), std::string::npos);
}

TEST(SimulateCommand, RefusesAnUnknownWorldAndNamesTheKnown) {
  const ScratchFolder scratch;
  const Outcome outcome = azimuth({"simulate", scratch / "run", "--world", "moon"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("corridor"), std::string::npos);
}

TEST(SimulateCommand, OverwritesOnlyWhenForced) {
  const ScratchFolder scratch;
  const std::string run = scratch / "run";
  ASSERT_EQ(azimuth({"simulate", run, "--world", "coloured-lab"}).code, 0);
  EXPECT_EQ(azimuth({"simulate", run, "--world", "coloured-lab"}).code, 2);
  EXPECT_EQ(azimuth({"simulate", run, "--world", "coloured-lab", "--force"}).code, 0);
}

}  // namespace
}  // namespace azimuth::test
