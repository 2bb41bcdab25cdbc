#include <gtest/gtest.h>

#include "tests/support/places.hpp"
#include "tests/tools/azimuth/command_line.hpp"

namespace azimuth::test {
namespace {

const std::string kShippedRun = test::source_folder() / "runs/lab";

TEST(ConvertCommand, ThereAndBackKeepsEveryBit) {
  const ScratchFolder scratch;
  const std::string log = scratch / "lab.lcmlog", folder = scratch / "lab";
  ASSERT_EQ(azimuth({"convert", kShippedRun, log}).code, 0);
  ASSERT_EQ(azimuth({"convert", log, folder}).code, 0);
  EXPECT_EQ(folder_bytes(folder), folder_bytes(kShippedRun));

  const std::string digest = digest_of(kShippedRun);
  EXPECT_EQ(digest.size(), 16u) << digest;
  EXPECT_EQ(digest_of(log), digest);
  EXPECT_EQ(digest_of(folder), digest);
}

TEST(ConvertCommand, OverwritesOnlyWhenForced) {
  const ScratchFolder scratch;
  const std::string log = scratch / "lab.lcmlog";
  write_file(log, "precious");
  const Outcome refused = azimuth({"convert", kShippedRun, log});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--force"), std::string::npos);
  EXPECT_EQ(file_bytes(log), "precious");
  EXPECT_EQ(azimuth({"convert", kShippedRun, log, "--force"}).code, 0);
  EXPECT_GT(file_bytes(log).size(), 1000u);
}

TEST(ConvertCommand, RefusesANameOfTheOtherKind) {
  const ScratchFolder scratch;
  std::filesystem::create_directory(scratch / "folder.lcmlog");
  write_file(scratch / "file", "precious");
  EXPECT_EQ(azimuth({"convert", kShippedRun, scratch / "folder.lcmlog", "--force"}).code, 2);
  EXPECT_EQ(azimuth({"convert", kShippedRun, scratch / "file", "--force"}).code, 2);
  EXPECT_EQ(file_bytes(scratch / "file"), "precious");
}

TEST(ConvertCommand, RefusesItsOwnInput) {
  const ScratchFolder scratch;
  const std::string run = scratch / "run";
  ASSERT_EQ(azimuth({"simulate", run, "--world", "coloured-lab"}).code, 0);
  const auto before = folder_bytes(run);
  EXPECT_EQ(azimuth({"convert", run, run, "--force"}).code, 2);
  EXPECT_EQ(folder_bytes(run), before);
}

TEST(ConvertCommand, LeavesNothingBehindForABadInput) {
  const ScratchFolder scratch;
  EXPECT_EQ(azimuth({"convert", scratch / "nowhere", scratch / "out"}).code, 2);
  EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
}

}  // namespace
}  // namespace azimuth::test
