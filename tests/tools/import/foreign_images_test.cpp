#include "tools/import/foreign_images.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace azimuth::test {
namespace {

constexpr const char* kJpeg = "\xff\xd8\xff\xe0 and so on";
const std::string kPng("\x89PNG\r\n\x1a\n and so on", 18);

void write(const std::filesystem::path& file, const std::string& bytes) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << bytes;
}

std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string problem_of(const FileResult<std::vector<SourceImage>>& images) {
  return images ? "" : text(images.error());
}

auto images_by_name(const std::filesystem::path& folder, std::string_view unit) {
  std::uint64_t empty = 0;
  return azimuth::images_by_name(folder, unit, empty);
}
auto images_by_table(const std::filesystem::path& folder, const ForeignText& table) {
  std::uint64_t empty = 0;
  return azimuth::images_by_table(folder, table, empty);
}

TEST(StampInAName, IsItsLastNumber) {
  EXPECT_EQ(stamp_in_name("1.5", 0), stamp_from_us(1'500'000));
  EXPECT_EQ(stamp_in_name("cam0_1403636579763555584", 9), stamp_from_us(1'403'636'579'763'556));
  EXPECT_EQ(stamp_in_name("frame-12.25-left", 0), stamp_from_us(12'250'000));
  EXPECT_EQ(stamp_in_name("frame12.", 0), stamp_from_us(12'000'000));
  EXPECT_FALSE(stamp_in_name("left", 0));
  EXPECT_FALSE(stamp_in_name("", 0));
  EXPECT_FALSE(stamp_in_name("...", 0));
}

TEST(ImagesByName, ComeInTheOrderOfTheirStamps) {
  const TemporaryFolder folder;
  write(folder / "f10.PNG", kPng);
  write(folder / "f9.5.jpg", kJpeg);
  write(folder / "notes.txt", "not an image");
  const auto images = images_by_name(folder.path(), "s");
  ASSERT_TRUE(images) << text(images.error());
  ASSERT_EQ(images->size(), 2u);
  EXPECT_EQ(images->at(0).file.filename(), "f9.5.jpg");
  EXPECT_EQ(images->at(1).stamp, stamp_from_us(10'000'000));
}

TEST(ImagesByName, AreRefusedWithTheirReason) {
  const TemporaryFolder folder;
  EXPECT_NE(problem_of(images_by_name(folder.path(), "s")).find("there are no images in it"), std::string::npos);
  EXPECT_NE(problem_of(images_by_name(folder / "nowhere", "s")).find("cannot be read"), std::string::npos);
  EXPECT_NE(problem_of(images_by_name(folder.path(), "min")).find("--stamps name[min]: must be one of"),
            std::string::npos);
  write(folder / "left.jpg", kJpeg);
  write(folder / "a1.jpg", kJpeg);
  write(folder / "b1.jpg", kJpeg);
  write(folder / "2.jpg", "BM");
  const std::string all = problem_of(images_by_name(folder.path(), "s"));
  EXPECT_NE(all.find("left.jpg: its name holds no time in s"), std::string::npos) << all;
  EXPECT_NE(all.find("a1.jpg and b1.jpg have the same stamp"), std::string::npos) << all;
  EXPECT_NE(all.find("2.jpg: is neither JPEG nor PNG"), std::string::npos) << all;
  write(folder / "2.jpg", "version https://git-lfs.github.com/spec/v1\noid sha256:0\n");
  EXPECT_NE(problem_of(images_by_name(folder.path(), "s")).find("2.jpg: is a pointer of git-lfs"), std::string::npos);
}

TEST(ImagesByName, OfAnotherUnitAreRefusedInOneLine) {
  const TemporaryFolder folder;
  for (const char* name : {"1700000000000000000.jpg", "1700000001000000000.jpg"}) write(folder / name, kJpeg);
  EXPECT_EQ(problem_of(images_by_name(folder.path(), "s")),
            folder.path().string() +
                ": of 2 names, such as 1700000000000000000.jpg, none holds a time in s that is in range: --stamps "
                "name[ns]?\n");
  EXPECT_TRUE(images_by_name(folder.path(), "ns"));
}

TEST(ImagesByName, WithoutAByteAreLeftOutAndCounted) {
  const TemporaryFolder folder;
  write(folder / "1.jpg", kJpeg);
  write(folder / "2.jpg", "");
  write(folder / "3.jpg", kJpeg);
  std::uint64_t empty = 0;
  const auto images = azimuth::images_by_name(folder.path(), "s", empty);
  ASSERT_TRUE(images) << text(images.error());
  EXPECT_EQ(images->size(), 2u);
  EXPECT_EQ(empty, 1u);
  const ForeignText table{"t_s,file\n1,1.jpg\n2,2.jpg\n", "rgb.csv", "", "-"};
  EXPECT_EQ(azimuth::images_by_table(folder.path(), table, empty)->size(), 1u);
  EXPECT_EQ(empty, 2u);
  write(folder / "none/1.jpg", "");
  EXPECT_NE(problem_of(azimuth::images_by_name(folder / "none", "s", empty)).find("not one image in it has a byte"),
            std::string::npos);
}

TEST(ImagesByTable, StandBelowTheFolderOrBesideTheTable) {
  const TemporaryFolder folder;
  write(folder / "rgb/a.jpg", kJpeg);
  write(folder / "rgb/b.png", kPng);
  const ForeignText table{"# t file\n1 a.jpg\n2 rgb/b.png\n", (folder / "rgb.txt").string(), "t_s=1,file=2", "-"};
  const auto images = images_by_table(folder / "rgb", table);
  ASSERT_TRUE(images) << text(images.error());
  EXPECT_EQ(images->at(1).stamp, stamp_from_us(2'000'000));
  EXPECT_EQ(content(images->at(1).file), kPng);
}

TEST(ImagesByTable, NameTheLineOfAFileThatIsNotThere) {
  const TemporaryFolder folder;
  const ForeignText table{"t_s,file\n1,a.jpg\n", "rgb.csv", "", "-"};
  EXPECT_EQ(problem_of(images_by_table(folder.path(), table)),
            "rgb.csv:2: there is no file " + (folder / "a.jpg").string() + "\n");
}

TEST(BroughtImages, AreCopiesThatKeepTheirBytes) {
  const TemporaryFolder folder;
  write(folder / "in/1.jpg", kJpeg);
  write(folder / "in/2.png", kPng);
  write(folder / "precious.jpg", "precious");
  std::filesystem::create_directories(folder / "out/frames");
  std::filesystem::create_hard_link(folder / "precious.jpg", folder / "out/frames/000000.jpg");
  const auto frames = bring_images(*images_by_name(folder / "in", "s"), folder / "out", folder / "out");
  ASSERT_TRUE(frames) << text(frames.error());
  EXPECT_EQ(frames->at(0).file, "frames/000000.jpg");
  EXPECT_EQ(frames->at(1).file, "frames/000001.png");
  EXPECT_EQ(content(folder / "out/frames/000001.png"), kPng);
  EXPECT_EQ(content(folder / "precious.jpg"), "precious") << "written through a link";
}

TEST(BroughtImages, StayWhereTheyAreBelowTheRun) {
  const TemporaryFolder folder;
  write(folder / "out/camera/1.jpg", kJpeg);
  const auto frames = bring_images(*images_by_name(folder / "out/camera", "s"), folder / "out", folder / "out");
  ASSERT_TRUE(frames) << text(frames.error());
  EXPECT_EQ(frames->at(0).file, "camera/1.jpg");
  EXPECT_FALSE(std::filesystem::exists(folder / "out/frames"));
}

}  // namespace
}  // namespace azimuth::test
