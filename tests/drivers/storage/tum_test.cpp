#include "drivers/storage/tum.hpp"

#include <gtest/gtest.h>
#include <numbers>

#include "tests/drivers/storage/samples.hpp"

namespace azimuth {
namespace {

TEST(Tum, OneLineAPose) {
  const std::pair<Stamp, Pose2> trajectory[] = {{stamp_from_us(1'500'000), {1.25, -2.0, 0.0}},
                                                {stamp_from_us(2'000'001), {0.1, 0.0, -std::numbers::pi}}};
  EXPECT_EQ(tum_text(trajectory),
            "1.500000 1.25 -2 0 0 0 0 1\n"
            "2.000001 0.1 0 0 0 0 -1 6.123233995736766e-17\n");
}

TEST(Tum, WritesAFileOrSaysWhyNot) {
  const test::TemporaryFolder folder;
  const std::pair<Stamp, Pose2> trajectory[] = {{stamp_from_us(0), {}}};
  EXPECT_TRUE(write_tum(trajectory, folder / "t.tum"));
  EXPECT_EQ(test::read(folder / "t.tum"), "0.000000 0 0 0 0 0 0 1\n");
  const auto written = write_tum(trajectory, folder / "missing/t.tum");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().front().text(),
            (folder / "missing/t.tum").string() + ": cannot be written: No such file or directory");
}

}  // namespace
}  // namespace azimuth
