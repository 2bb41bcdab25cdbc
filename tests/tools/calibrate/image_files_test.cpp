#include "tools/calibrate/image_files.hpp"

#include <array>
#include <fstream>
#include <gmock/gmock.h>

#include "tests/support/temporary_folder.hpp"

namespace azimuth {
namespace {

using ::testing::ElementsAre;

constexpr std::array kNames{"a", "b", "c", "d", "e", "f", "g"};

class ImageFiles : public testing::Test {
 protected:
  void touch(const std::string& name) const {
    const std::filesystem::path file = folder_.path() / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << "x";
  }
  std::vector<std::string> names(const std::vector<std::filesystem::path>& arguments, std::size_t most = 100) const {
    const auto files = image_files(arguments, most);
    if (!files) return {"refused"};
    std::vector<std::string> all;
    for (const auto& file : *files) all.push_back(file.lexically_relative(folder_.path()).string());
    return all;
  }
  test::TemporaryFolder folder_;
};

TEST_F(ImageFiles, OfAFolderAreItsImagesByName) {
  for (const char* name : {"b.jpg", "a.pgm", "notes.txt"}) touch(name);
  EXPECT_THAT(names({folder_.path()}), ElementsAre("a.pgm", "b.jpg"));
}

TEST_F(ImageFiles, OfARunAreItsFrames) {
  for (const char* name : {"frames/000001.jpg", "frames/000000.jpg", "map.ppm"}) touch(name);
  EXPECT_THAT(names({folder_.path()}), ElementsAre("frames/000000.jpg", "frames/000001.jpg"));
}

TEST_F(ImageFiles, AreSpreadEvenlyWhenThereAreMany) {
  for (char name = '0'; name <= '9'; ++name) touch(std::string(1, name) + ".jpg");
  EXPECT_THAT(names({folder_.path()}, 5), ElementsAre("0.jpg", "2.jpg", "4.jpg", "6.jpg", "8.jpg"));
}

TEST_F(ImageFiles, AreTakenInPairs) {
  const auto pairs = [](std::size_t files, std::size_t most) {
    std::string all;
    for (const auto& [a, b] :
         image_pairs(std::vector<std::filesystem::path>(kNames.begin(),
                                                        std::next(kNames.begin(), static_cast<std::ptrdiff_t>(files))),
                     most))
      all += a.string() + b.string() + ' ';
    return all;
  };
  EXPECT_EQ(pairs(7, 3), "ab cd ef ");
  EXPECT_EQ(pairs(4, 20), "ab bc cd ");
  EXPECT_EQ(pairs(1, 20), "");
}

TEST_F(ImageFiles, GivenByNameNeedNoKnownExtension) {
  EXPECT_THAT(names({folder_.path() / "x.raw"}), ElementsAre("x.raw"));
}

TEST_F(ImageFiles, AnEmptyFolderIsRefused) { EXPECT_THAT(names({folder_.path()}), ElementsAre("refused")); }

}  // namespace
}  // namespace azimuth
