#include "tools/export/export_file.hpp"

#include <gtest/gtest.h>

#include "tests/tools/export/sample.hpp"

namespace azimuth::test {
namespace {

TEST(ExportRequest, GoesByTheEndingOrByWhatStandsBefore) {
  EXPECT_EQ(export_request("a/drive.mcap")->format, ExportFormat::mcap);
  EXPECT_EQ(export_request("a/drive.mcap")->file, "a/drive.mcap");
  EXPECT_EQ(export_request("drive.bag")->format, ExportFormat::bag);
  EXPECT_EQ(export_request("kitti:poses.txt")->format, ExportFormat::kitti);
  EXPECT_EQ(export_request("kitti:poses.txt")->file, "poses.txt");
  EXPECT_EQ(export_request("tum:drive.bag")->format, ExportFormat::tum);
  EXPECT_EQ(export_request("robot:1.csv")->file, "robot:1.csv") << "a colon of the name itself";
}

TEST(ExportRequest, RefusesWhatSaysNoFormat) {
  for (const char* text : {"", "poses.txt", "mcap", "bag:", "kitti", ".mcap", "drive.mcap.gz", "x:poses.txt"})
    EXPECT_FALSE(export_request(text)) << text;
}

TEST(ExportFormats, AreNamedForAPerson) {
  EXPECT_EQ(export_formats_text(), "tum, kitti, kitti_times, csv, geojson, bag or mcap");
}

TEST(Exported, HasSomethingInEveryFormatAndTheSameEachTime) {
  for (const ExportFormatName& each : kExportFormats) {
    const Exported content = exported(sample(), each.format, std::nullopt);
    ASSERT_TRUE(content) << each.name;
    EXPECT_GT(content->size(), 100u) << each.name;
    EXPECT_EQ(*content, *exported(sample(), each.format, std::nullopt)) << each.name;
  }
}

TEST(Exported, OfTimesThatRosCannotCountSaysSo) {
  Estimated early = sample(2), late = sample(2);
  early.poses[0].stamp = stamp_from_us(-1);
  late.poses[1].stamp = stamp_from_us(2'200'000'000'000'000);
  EXPECT_EQ(exported(early, ExportFormat::bag, {}).error(),
            "its stamps are not between 1970 and 2106, and ROS 1 counts no others");
  EXPECT_FALSE(exported(early, ExportFormat::mcap, {}));
  EXPECT_FALSE(exported(late, ExportFormat::mcap, {}));
  EXPECT_TRUE(exported(late, ExportFormat::bag, {}));
  EXPECT_TRUE(exported(early, ExportFormat::csv, {}));
}

}  // namespace
}  // namespace azimuth::test
