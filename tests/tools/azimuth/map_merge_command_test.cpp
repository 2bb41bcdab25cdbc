// Runs `azimuth map merge`: its output, the map that it writes and the maps that it refuses.

#include <filesystem>
#include <gtest/gtest.h>

#include "drivers/storage/map_file.hpp"
#include "tests/map_merge/map_pair.hpp"
#include "tests/tools/azimuth/command_line.hpp"

namespace azimuth::test {
namespace {

class MapMergeCommand : public testing::Test {
 protected:
  /// Writes a map of the part of the hall between `from_m` and `to_m` (x), and returns its path.
  std::string map(const std::string& name, double from_m, double to_m, const Pose2& T_world_map) {
    return write(name, drawn_map(between(hall_, from_m, to_m), T_world_map, draws_).map);
  }
  std::string write(const std::string& name, const MapSnapshot& map) {
    std::vector<std::byte> bytes;
    encode(map, bytes);
    EXPECT_TRUE(write_map(bytes, scratch_ / name));
    return scratch_ / name;
  }
  std::string west() { return map("west.azmap", 0.0, 37.0, {10.0, 5.0, 0.7}); }
  std::string east() { return map("east.azmap", 23.0, 60.0, {40.0, 9.0, -2.4}); }

  /// Expects that the command ends with exit code 2, gives the reason `why` on one line and writes no file.
  void expect_refused(const std::vector<std::string>& maps, const std::string& why) {
    std::vector<std::string> arguments{"map", "merge", "-o", out_};
    arguments.insert(arguments.end(), maps.begin(), maps.end());
    const Outcome outcome = azimuth(arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(out_));
  }

  ScratchFolder scratch_;
  RandomDraws draws_{21};
  std::vector<TrueLandmark3> hall_ = drawn_hall(draws_);
  std::string out_ = scratch_ / "hall.azmap";
};

TEST_F(MapMergeCommand, MakesOneMapOfTwo) {
  const std::string a = west(), b = east();
  const Outcome outcome = azimuth({"map", "merge", a, b, "-o", out_});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const std::size_t of_a = read_map(a)->map.landmarks.size(), of_b = read_map(b)->map.landmarks.size();
  const std::string counts = b + ": " + std::to_string(of_a + of_b - hall_.size()) + " of its " + std::to_string(of_b) +
                             " landmarks are among the " + std::to_string(of_a);
  EXPECT_NE(outcome.out.find("merged      " + counts), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("saved       " + out_ + ", 40 landmarks"), std::string::npos) << outcome.out;
  const MapSnapshot merged = read_map(out_)->map;
  EXPECT_EQ(merged.landmarks.size(), hall_.size());
  EXPECT_EQ(merged.landmarks.front().id, read_map(a)->map.landmarks.front().id) << "in the frame of the first";
}

TEST_F(MapMergeCommand, WritesTheSameBytesEveryTimeAndKeepsTheMapBefore) {
  const std::string a = west(), b = east();
  write("hall.azmap", read_map(b)->map);
  const std::string before = file_bytes(out_);
  EXPECT_EQ(azimuth({"map", "merge", a, b, "-o", out_, "--quiet"}).out, "");
  EXPECT_EQ(file_bytes(out_ + ".previous"), before);
  const std::string again = scratch_ / "again.azmap";
  ASSERT_EQ(azimuth({"map", "merge", a, b, "-o", again}).code, 0);
  EXPECT_EQ(file_bytes(again), file_bytes(out_));
}

TEST_F(MapMergeCommand, TakesSeveralInAnyOrder) {
  const std::string a = map("a.azmap", 0.0, 25.0, {1.0, 2.0, 0.3}), b = map("b.azmap", 11.0, 43.0, {30.0, 9.0, 2.0}),
                    c = map("c.azmap", 29.0, 60.0, {50.0, 4.0, -1.0});
  const Outcome outcome = azimuth({"map", "merge", a, c, b, "-o", out_});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_LT(outcome.out.find("merged      " + b), outcome.out.find("merged      " + c)) << "c overlaps only b\n"
                                                                                        << outcome.out;
  EXPECT_EQ(read_map(out_)->map.landmarks.size(), hall_.size());
}

TEST_F(MapMergeCommand, RefusesWhatHasNothingInCommon) {
  const std::string a = west();
  hall_ = drawn_hall(draws_);
  expect_refused({a, east()}, "east.azmap: nothing that it has in common with " + a + " is beyond chance");
}

TEST_F(MapMergeCommand, RefusesWhatFitsInSeveralWays) {
  for (std::size_t i = 0; i < hall_.size(); ++i)
    hall_[i].p_world_m.head<2>() << 3.0 + 6.0 * static_cast<double>(i / 4), 2.0 + 5.0 * static_cast<double>(i % 4);
  const std::string a = west();
  expect_refused({a, east()}, "east.azmap: fits " + a + " in more than one way");
}

TEST_F(MapMergeCommand, RefusesWhatWouldCountTwice) {
  const std::string a = west(), b = east();
  expect_refused({a, a}, a + ": has landmarks of " + a + " to the last bit");
  std::filesystem::copy_file(a, scratch_ / "copy.azmap");
  expect_refused({a, b, scratch_ / "copy.azmap"}, "copy.azmap: has landmarks of " + a + " to the last bit");
  const Outcome onto_itself = azimuth({"map", "merge", a, b, "-o", b});
  EXPECT_EQ(onto_itself.code, 2);
  EXPECT_NE(onto_itself.err.find(b + ": is one of the maps to be merged"), std::string::npos) << onto_itself.err;
}

TEST_F(MapMergeCommand, RefusesMapsThatAreTooDifferent) {
  const std::string a = west();
  MapSnapshot named = read_map(east())->map;
  named.names = MapNames::sensor;
  for (std::size_t i = 0; i < named.landmarks.size(); ++i) named.landmarks[i].identity = static_cast<Identity>(i + 1);
  const std::string b = write("named.azmap", named);
  expect_refused({a, b}, "named.azmap: cannot be merged with " + a + ": the landmarks of one have names");
}

TEST_F(MapMergeCommand, RefusesACutFileAndOneThatIsNotThere) {
  const std::string a = west(), b = east();
  const std::string bytes = file_bytes(b);
  write_file(b, bytes.substr(0, bytes.size() / 2));
  expect_refused({a, b}, "east.azmap: is ");
  expect_refused({a, scratch_ / "none.azmap"}, "none.azmap: ");
}

TEST_F(MapMergeCommand, WantsTwoMapsAndAFileToWrite) {
  const std::string a = west(), b = east();
  const Outcome nowhere = azimuth({"map", "merge", a, b});
  EXPECT_EQ(nowhere.code, 2);
  EXPECT_NE(nowhere.err.find("--out is required"), std::string::npos) << nowhere.err;
  EXPECT_EQ(azimuth({"map", "merge", a, "-o", out_}).code, 2);
  const Outcome folder = azimuth({"map", "merge", a, b, "-o", scratch_ / ""});
  EXPECT_EQ(folder.code, 1);
  EXPECT_NE(folder.err.find("cannot be written: is a folder"), std::string::npos) << folder.err;
  EXPECT_FALSE(std::filesystem::exists(out_));
}

}  // namespace
}  // namespace azimuth::test
