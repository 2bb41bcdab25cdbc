// Runs `azimuth map`, and `azimuth replay` that starts from a map.

#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>

#include "drivers/storage/map_file.hpp"
#include "tests/support/places.hpp"
#include "tests/tools/azimuth/command_line.hpp"

namespace azimuth::test {
namespace {

using Json = nlohmann::json;

class MapCommand : public testing::Test {
 protected:
  void SetUp() override {
    const Outcome saved = azimuth({"map", "save", test::one_lap(), "--map", map_});
    ASSERT_EQ(saved.code, 0) << saved.err;
    EXPECT_NE(saved.out.find("24 of 24 landmarks"), std::string::npos);
  }

  void damage(const std::string& file) {
    std::string bytes = file_bytes(file);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
    write_file(file, bytes);
  }

  ScratchFolder scratch_;
  std::string map_ = scratch_ / "lab.azmap";
};

TEST_F(MapCommand, SavesTheSameBytesEveryTime) {
  const std::string again = scratch_ / "again.azmap";
  EXPECT_EQ(azimuth({"map", "save", test::one_lap(), "--map", again, "--quiet"}).out, "");
  EXPECT_EQ(file_bytes(again), file_bytes(map_));
}

TEST_F(MapCommand, InfoSaysWhatIsInIt) {
  const Outcome text = azimuth({"map", "info", map_});
  EXPECT_EQ(text.code, 0);
  EXPECT_NE(text.out.find("landmarks   24"), std::string::npos) << text.out;
  const Json json = Json::parse(azimuth({"map", "info", map_, "--json"}).out);
  EXPECT_EQ(json["landmarks"], 24);
  EXPECT_EQ(json["bytes"], std::filesystem::file_size(map_));
  EXPECT_EQ(json["version"], 1);
  EXPECT_LT(json["sigma_m"]["max"], 1.0);
}

TEST_F(MapCommand, ExportsEveryLandmarkToBothFormats) {
  const MapSnapshot map = read_map(map_)->map;
  const Json collection = Json::parse(azimuth({"map", "export", map_}).out);
  EXPECT_EQ(collection["type"], "FeatureCollection");
  ASSERT_EQ(collection["features"].size(), map.landmarks.size() + 1) << "and the robot";
  EXPECT_EQ(collection["features"][3]["geometry"]["coordinates"][0], map.landmarks[3].p_map_landmark_m.x());
  const std::string file = scratch_ / "map.csv";
  EXPECT_EQ(azimuth({"map", "export", map_, "--format", "csv", "-o", file}).code, 0);
  std::istringstream lines(file_bytes(file));
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);) ++count;
  EXPECT_EQ(count, map.landmarks.size() + 1);
  const Outcome refused = azimuth({"map", "export", map_, "--origin", "91,0"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("LAT,LON"), std::string::npos);
}

TEST_F(MapCommand, ExportSaysWhatItsCoordinatesAre) {
  const Outcome local = azimuth({"map", "export", map_}), placed = azimuth({"map", "export", map_, "--origin", "48,9"});
  EXPECT_NE(local.err.find("metres in the map's own frame"), std::string::npos);
  EXPECT_EQ(placed.err, "");
  EXPECT_TRUE(Json::parse(local.out)["crs"].is_null());
}

TEST_F(MapCommand, ReplayStartsFromAMap) {
  const Outcome from_map = azimuth({"replay", test::one_lap(), "--map", map_, "--set", "map.mode=localise"});
  ASSERT_EQ(from_map.code, 0) << from_map.err;
  EXPECT_NE(from_map.out.find("map         " + map_), std::string::npos) << from_map.out;
  const std::string localised = digest_of(test::one_lap(), {"--map", map_, "--localise"});
  EXPECT_NE(from_map.out.find(localised), std::string::npos) << "two ways to say the same";
  EXPECT_EQ(digest_of(test::one_lap(), {"--map", map_, "--localise"}), localised) << "and the same every time";
  EXPECT_NE(digest_of(test::one_lap()), localised);
  EXPECT_NE(digest_of(test::one_lap(), {"--map", map_}), localised) << "to go on mapping is another matter";
}

TEST_F(MapCommand, ALocalisingReplayLeavesTheMapAsItIs) {
  const std::string kept = scratch_ / "kept.azmap";
  ASSERT_EQ(azimuth({"map", "save", test::one_lap(), "--from", map_, "--localise", "--map", kept}).code, 0);
  EXPECT_EQ(Json::parse(azimuth({"map", "export", kept}).out)["features"][5]["geometry"],
            Json::parse(azimuth({"map", "export", map_}).out)["features"][5]["geometry"]);
}

TEST_F(MapCommand, ADamagedMapIsRefusedAndTheOneBeforeUsed) {
  ASSERT_EQ(azimuth({"map", "save", test::one_lap(), "--map", map_, "--set", "ekf.thinning_s=0.6"}).code, 0);
  damage(map_);
  const Outcome info = azimuth({"map", "info", map_});
  EXPECT_EQ(info.code, 0);
  EXPECT_NE(info.err.find("checksum is wrong"), std::string::npos);
  EXPECT_NE(info.err.find("used " + map_ + ".previous"), std::string::npos);
  damage(map_ + ".previous");
  for (const std::vector<std::string>& command : {std::vector<std::string>{"map", "info", map_},
                                                  {"map", "export", map_},
                                                  {"replay", test::one_lap(), "--map", map_}}) {
    const Outcome refused = azimuth(command);
    EXPECT_EQ(refused.code, 2);
    EXPECT_EQ(refused.out, "");
    EXPECT_NE(refused.err.find(map_ + ".previous: is damaged"), std::string::npos) << refused.err;
  }
}

TEST_F(MapCommand, SaysWhyAMapDoesNotFit) {
  const Outcome fastslam = azimuth({"replay", test::one_lap(), "--map", map_, "--set", "estimator=fastslam"});
  EXPECT_EQ(fastslam.code, 2);
  EXPECT_NE(fastslam.err.find("its landmarks have no heights, and estimator \"fastslam\" maps in space"),
            std::string::npos)
      << fastslam.err;
  const Outcome without = azimuth({"replay", test::one_lap(), "--localise"});
  EXPECT_EQ(without.code, 2);
  EXPECT_NE(without.err.find("needs a map"), std::string::npos);
}

}  // namespace
}  // namespace azimuth::test
