#include "daemon/record/archive.hpp"

#include <fcntl.h>
#include <fstream>
#include <gmock/gmock.h>
#include <sys/file.h>

#include "base/unique_fd.hpp"
#include "tests/daemon/record/recording.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;

class ArchiveTest : public testing::Test {
 protected:
  fs::path make(const std::string& name, std::size_t bytes = 10) {
    const fs::path file = folder_ / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file) << std::string(bytes, 'x');
    return file;
  }
  /// Deletes everything that may be deleted and returns the files in the order of their deletion.
  std::vector<std::string> deleted(Archive& archive) {
    std::vector<std::string> order;
    for (auto before = files(); archive.delete_oldest(); before = files()) {
      const auto after = files();
      std::ranges::set_difference(before, after, std::back_inserter(order));
    }
    return order;
  }
  std::vector<std::string> files() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path())) {
      if (entry.is_regular_file()) found.push_back(fs::relative(entry.path(), folder_.path()).string());
    }
    std::ranges::sort(found);
    return found;
  }

  test::TemporaryFolder folder_;
};

TEST_F(ArchiveTest, OldestSessionsFirstOwnLast) {
  const std::vector<std::string> in_order{"2026-01-01T00-00-00Z/007.lcm",    "2026-01-01T00-00-00Z-2/000.lcm",
                                          "2026-01-01T00-00-00Z-10/000.lcm", "2026-01-01T00-00-01Z/999.lcm",
                                          "2026-01-01T00-00-01Z/1000.lcm",   "2019-01-01T00-00-00Z/000.lcm"};
  for (const std::string& name : in_order) make(name);
  const std::string last = "2019-01-01T00-00-00Z/001.lcm";
  make(last);
  Archive archive(folder_.path());
  archive.scan("2019-01-01T00-00-00Z", {});  // the current session, from a clock that was set back
  EXPECT_EQ(archive.bytes(), 70U);
  EXPECT_EQ(deleted(archive), in_order);
  EXPECT_EQ(archive.bytes(), 10U);
  EXPECT_EQ(files(), std::vector{last}) << "the session's own last one is kept";
  EXPECT_EQ(test::sessions(folder_.path()).size(), 1U) << "empty sessions go with their last segment";
}

TEST_F(ArchiveTest, TouchesNothingOfOthers) {
  const std::vector<std::string> others{"000.lcm",
                                        "2026-01-01T00-00-00/000.lcm",
                                        "2026-01-01T00-00-00Z-/000.lcm",
                                        "2026-01-01T00-00-00Z-x/000.lcm",
                                        "2026-01-01T00-00-00Z/notes.txt",
                                        "2026-01-01T00-00-00Z/0.lcm",
                                        "photos/000.lcm",
                                        "x2026-01-01T00-00-00Z/000.lcm"};
  for (const std::string& name : others) make(name);
  make("2026-01-01T00-00-00Z/000.lcm");
  Archive archive(folder_.path());
  archive.scan("", {});
  EXPECT_EQ(archive.bytes(), 10U);
  EXPECT_EQ(deleted(archive), std::vector<std::string>{"2026-01-01T00-00-00Z/000.lcm"});
  EXPECT_THAT(files(), testing::UnorderedElementsAreArray(others));
}

TEST_F(ArchiveTest, LeavesOpenSegmentsAlone) {
  const fs::path mine = make("2026-01-02T00-00-00Z/000.lcm"), theirs = make("2026-01-01T00-00-00Z/000.lcm");
  make("2026-01-01T00-00-00Z/001.lcm");
  const UniqueFd recorder(::open(theirs.c_str(), O_WRONLY));
  ASSERT_EQ(::flock(recorder.get(), LOCK_EX), 0);
  Archive archive(folder_.path());
  archive.scan("2026-01-02T00-00-00Z", mine);
  EXPECT_EQ(deleted(archive), std::vector<std::string>{"2026-01-01T00-00-00Z/001.lcm"});
  EXPECT_TRUE(fs::exists(theirs));
  EXPECT_TRUE(fs::exists(mine));
  EXPECT_EQ(archive.bytes(), 10U) << "what could not be deleted still takes its room";
}

TEST_F(ArchiveTest, AMissingFolderIsEmpty) {
  Archive archive(folder_ / "nowhere");
  archive.scan("", {});
  EXPECT_EQ(archive.bytes(), 0U);
  EXPECT_FALSE(archive.delete_oldest());
}

TEST_F(ArchiveTest, FreeBytesAreThoseOfTheDiskTheFolderWillBeOn) {
  const auto here = free_bytes(folder_.path()), later = free_bytes(folder_ / "not/made/yet");
  ASSERT_TRUE(here && later);
  EXPECT_GT(*here, 0U);
  EXPECT_NEAR(static_cast<double>(*here), static_cast<double>(*later), 1e9);
  make("file");
  EXPECT_FALSE(free_bytes(folder_ / "file/below")) << "no such folder can be";
}

}  // namespace
}  // namespace azimuth
