#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <ostream>

#include "tests/support/places.hpp"
#include "tests/support/printed_name.hpp"
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

TEST(SimulateCommand, StopsAfterSomeSeconds) {
  const ScratchFolder scratch;
  const std::string run = scratch / "run";
  const Outcome outcome = azimuth({"simulate", run, "--world", "lab", "--seconds", "10"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("101 odometry readings"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("10.0 s"), std::string::npos) << outcome.out;
}

TEST(SimulateCommand, TakesImagesInPlaceOfBearings) {
  const ScratchFolder scratch;
  const std::string run = scratch / "run";
  const Outcome outcome =
      azimuth({"simulate", run, "--world", "coloured-lab", "--camera", "mirror", "--size", "0.25", "--seconds", "5"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("6 images"), std::string::npos) << outcome.out;
  EXPECT_NE(file_bytes(run + "/rig.toml").find("width_px = 256"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(run + "/frames/000005.jpg"));
  EXPECT_EQ(azimuth({"replay", run}).code, 0);
}

TEST(SimulateCommand, RefusesImagesInALogAndSizesWithoutACamera) {
  const ScratchFolder scratch;
  EXPECT_EQ(azimuth({"simulate", scratch / "run.lcmlog", "--camera", "mirror"}).code, 2);
  EXPECT_EQ(azimuth({"simulate", scratch / "run", "--size", "0.5"}).code, 2);
  EXPECT_EQ(azimuth({"simulate", scratch / "run", "--camera", "pinhole"}).code, 2);
}

/// A shipped run and the largest RMSE that its positions may have.
struct ShippedMap {
  std::string run;
  double most_m;
};
std::ostream& operator<<(std::ostream& out, const ShippedMap& map) { return out << map.run; }

class ShippedRuns : public testing::TestWithParam<ShippedMap> {};
INSTANTIATE_TEST_SUITE_P(Of, ShippedRuns,
                         testing::Values(ShippedMap{"mirror", 0.085}, ShippedMap{"alike", 0.11},
                                         ShippedMap{"lamps", 0.042}),
                         PrintedName());

TEST_P(ShippedRuns, IsMapped) {
  const ScratchFolder scratch;
  const std::string report = scratch / "report.json";
  ASSERT_EQ(azimuth({"replay", source_folder() / "runs" / GetParam().run, "--report", report}).code, 0);
  const auto said = nlohmann::json::parse(file_bytes(report));
  EXPECT_EQ(said.at("health"), "tracking");
  EXPECT_LT(said.at("pose").at("rmse_m"), GetParam().most_m);
  EXPECT_LT(said.at("pose").at("anees_tracking"), 3.6);
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
