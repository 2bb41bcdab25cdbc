#include "drivers/storage/map_file.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

#include "tests/support/random_map.hpp"
#include "tests/support/temporary_folder.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;

std::vector<std::byte> encoded(unsigned seed) {
  std::vector<std::byte> bytes;
  encode(random_map(seed), bytes);
  return bytes;
}

std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void put(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

void damage(const fs::path& file) {
  std::string text = content(file);
  text[text.size() / 2] = static_cast<char>(text[text.size() / 2] ^ 1);
  put(file, text);
}

class MapFile : public testing::Test {
 protected:
  void save(unsigned seed) { ASSERT_TRUE(write_map(encoded(seed), file_)); }
  /// The seed of the map that is read; 0: none.
  unsigned read() const {
    const auto loaded = read_map(file_);
    if (!loaded) return 0;
    for (unsigned seed = 1; seed < 10; ++seed)
      if (loaded->bytes == encoded(seed)) return seed;
    return 99;
  }

  test::TemporaryFolder folder_;
  fs::path file_ = folder_.path() / "deep" / "map.azmap";
};

TEST_F(MapFile, KeepsTheNewestAndTheOneBefore) {
  EXPECT_FALSE(map_exists(file_));
  save(1);
  EXPECT_EQ(read(), 1u);
  save(2);
  save(3);
  EXPECT_TRUE(map_exists(file_));
  EXPECT_EQ(read(), 3u);
  EXPECT_EQ(read_map_only(previous_map(file_))->bytes, encoded(2));
  EXPECT_EQ(std::distance(fs::directory_iterator(file_.parent_path()), {}), 2) << "nothing else is left lying about";
}

TEST_F(MapFile, FallsBackOnTheOneBeforeAndSaysWhy) {
  save(1);
  save(2);
  damage(file_);
  const auto loaded = read_map(file_);
  ASSERT_TRUE(loaded);
  EXPECT_EQ(loaded->bytes, encoded(1));
  EXPECT_EQ(loaded->file, previous_map(file_));
  ASSERT_EQ(loaded->troubles.size(), 1u);
  EXPECT_EQ(loaded->troubles[0].text(), file_.string() + ": is damaged: its checksum is wrong");
}

TEST_F(MapFile, KeepsAGoodMapRatherThanADamagedOne) {
  save(1);
  save(2);
  damage(file_);
  const std::string damaged = content(file_);
  save(3);
  EXPECT_EQ(read(), 3u);
  EXPECT_EQ(read_map_only(previous_map(file_))->bytes, encoded(1)) << "not what was damaged";
  EXPECT_EQ(content(fs::path(file_) += ".refused"), damaged) << "which is kept for whoever wants to know";
}

TEST_F(MapFile, SurvivesAnEndAtAnyMoment) {
  // GIVEN the files that an interrupted save leaves behind
  save(1);
  save(2);
  const fs::path fresh = fs::path(file_) += ".new";
  put(fresh, content(file_).substr(0, 100));  // interrupted while writing
  EXPECT_EQ(read(), 2u);
  put(fresh, content(file_));
  fs::rename(file_, previous_map(file_));  // interrupted between the renames
  EXPECT_EQ(read(), 2u);
  // WHEN the next map is saved
  save(3);
  // THEN no remains are left
  EXPECT_EQ(read(), 3u);
  EXPECT_EQ(read_map_only(previous_map(file_))->bytes, encoded(2));
  EXPECT_FALSE(fs::exists(fresh));
}

TEST_F(MapFile, NamesEverythingThatIsWrongWhenNothingCanBeRead) {
  save(1);
  save(2);
  damage(file_);
  damage(previous_map(file_));
  const auto loaded = read_map(file_);
  ASSERT_FALSE(loaded);
  EXPECT_EQ(loaded.error().size(), 2u);
}

TEST_F(MapFile, IsNotTouchedWhenTheDiskRefuses) {
  save(1);
  fs::create_directory(fs::path(file_) += ".new");  // makes writing impossible
  const auto written = write_map(encoded(2), file_);
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().front().message.find("cannot be written"), std::string::npos);
  EXPECT_EQ(read(), 1u);
}

TEST_F(MapFile, IsSetAsideUnderTheFirstFreeNumber) {
  const auto aside = [&](int number) { return fs::path(file_) += ".aside." + std::to_string(number); };
  EXPECT_TRUE(set_map_aside(file_)) << "none there is no trouble";
  for (unsigned seed = 1; seed <= 2; ++seed) {
    save(seed);
    EXPECT_TRUE(set_map_aside(file_));
    EXPECT_FALSE(fs::exists(file_));
  }
  EXPECT_EQ(read_map_only(aside(1))->bytes, encoded(1));
  EXPECT_EQ(read_map_only(aside(2))->bytes, encoded(2));
}

TEST_F(MapFile, RefusesWhatIsNoFile) {
  fs::create_directories(file_);
  EXPECT_FALSE(read_map(file_));
  EXPECT_FALSE(read_map(folder_.path() / "none"));
}

}  // namespace
}  // namespace azimuth
