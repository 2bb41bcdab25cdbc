// Base folders of relative paths in a configuration, and the treatment of paths written for version 0.1.0.

#include "settings/path_text.hpp"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>
#include <stdlib.h>

#include "settings/reader.hpp"
#include "tests/support/temporary_folder.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

PlacedPath placed(const std::string& path, const std::set<fs::path>& there) {
  return placed_path(path, "/etc/robot",
                     [&](const fs::path& asked) { return there.contains(asked.lexically_normal()); });
}

fs::path here(const std::string& path) { return fs::current_path() / path; }

TEST(PlacedPath, BeginsAtTheConfigurationsFolder) {
  for (const std::set<fs::path>& there : {std::set<fs::path>{}, {"/etc/robot/rig.toml"}}) {
    const PlacedPath rig = placed("rig.toml", there);
    EXPECT_EQ(rig.path, "/etc/robot/rig.toml");
    EXPECT_EQ(rig.warning, "");
  }
  EXPECT_EQ(placed("../rigs/a.toml", {}).path, "/etc/rigs/a.toml");
}

TEST(PlacedPath, LeavesAWholePathAlone) {
  EXPECT_EQ(placed("/a/rig.toml", {here("/a/rig.toml")}).path, "/a/rig.toml");
  EXPECT_EQ(placed("/a/rig.toml", {"/a/rig.toml"}).warning, "");
}

TEST(PlacedPath, IsStillFoundInTheWorkingDirectoryForARelease) {
  const PlacedPath old = placed("config/rig.toml", {here("config/rig.toml")});
  EXPECT_EQ(old.path, "config/rig.toml");
  EXPECT_THAT(old.warning, HasSubstr("write \"" + here("config/rig.toml").string() + '"'));
  const PlacedPath to_be_made = placed("logs/robot", {here("logs")});
  EXPECT_EQ(to_be_made.path, "logs/robot") << "its folder is there, and it was made in it";
  EXPECT_NE(to_be_made.warning, "");
}

TEST(PlacedPath, SaysWhenTheSameNameIsNowAnotherFile) {
  const PlacedPath both = placed("rig.toml", {here("rig.toml"), "/etc/robot/rig.toml"});
  EXPECT_EQ(both.path, "/etc/robot/rig.toml");
  EXPECT_THAT(both.warning, HasSubstr("no longer " + here("rig.toml").string()));
}

class PathsOfAFile : public testing::Test {
 protected:
  /// The messages about a file with this text.
  std::vector<std::string> read(const std::string& text) {
    std::vector<Section*> all = pointers(sections_);
    const fs::path file = folder_ / "robot.toml";
    EXPECT_THAT(read_toml(text, file.string(), all), IsEmpty());
    return place_paths(all, file);
  }

  test::TemporaryFolder folder_;
  std::string rig_, device_ = "links/robot", name_;
  std::vector<Section> sections_{
      {"", "", {}},
      {"daemon",
       "",
       {path_key("rig", rig_, "A file."),
        {"device",
         PathText{&device_, [](std::string_view text) { return text.starts_with("tcp:") ? std::string_view() : text; }},
         "A device or an address."},
        {"name", &name_, "No path at all."}}}};
};

TEST_F(PathsOfAFile, ArePlacedWhereTheyAreGiven) {
  EXPECT_THAT(read("[daemon]\nrig = \"rigs/a.toml\"\nname = \"a/b\"\n"), IsEmpty());
  EXPECT_EQ(rig_, (folder_ / "rigs/a.toml").string());
  EXPECT_EQ(name_, "a/b");
  EXPECT_EQ(device_, "links/robot") << "a default is not the file's";
}

TEST_F(PathsOfAFile, AreOnlyWhatIsAPath) {
  EXPECT_THAT(read("[daemon]\nrig = \"\"\ndevice = \"tcp:robot:8101\"\n"), IsEmpty());
  EXPECT_EQ(rig_, "");
  EXPECT_EQ(device_, "tcp:robot:8101");
}

TEST_F(PathsOfAFile, TheWarningNamesFileAndKey) {
  const std::string there = fs::directory_iterator(fs::current_path())->path().filename().string();
  EXPECT_THAT(read("[daemon]\nrig = \"" + there + "\"\n"), ElementsAre(HasSubstr("robot.toml: daemon.rig \"" + there)));
  EXPECT_EQ(rig_, there) << "as in the release before";
}

TEST_F(PathsOfAFile, OfTheCommandLineStayInTheWorkingDirectory) {
  std::vector<Section*> all = pointers(sections_);
  ASSERT_THAT(read("[daemon]\nrig = \"a.toml\"\n"), IsEmpty());
  EXPECT_THAT(apply_override("daemon.rig=rel/path", all), IsEmpty());
  EXPECT_EQ(rig_, "rel/path");
  EXPECT_THAT(apply_override("daemon.rig=7", all), IsEmpty()) << "a text needs no quotes";
  EXPECT_EQ(rig_, "7");
}

TEST_F(PathsOfAFile, TakeATextOnly) {
  std::vector<Section*> all = pointers(sections_);
  EXPECT_EQ(read_toml("[daemon]\nrig = 7\n", "robot.toml", all).size(), 1U);
}

}  // namespace
}  // namespace azimuth
