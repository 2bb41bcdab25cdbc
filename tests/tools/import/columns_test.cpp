#include "tools/import/columns.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <numbers>
#include <string>
#include <string_view>

#include "tools/import/foreign_table.hpp"

namespace azimuth::test {
namespace {

constexpr std::array<WantedColumn, 4> kWanted{{{"t_s"}, {"x_m"}, {"heading_rad"}, {"kind", false}}};

std::string refusal(std::string_view columns) {
  const auto read = parse_columns(columns, kWanted, "--columns");
  return read ? "" : text(read.error());
}

TEST(Columns, SayWhereAValueStandsAndInWhichUnit) {
  const auto columns = parse_columns("t_s=stamp[ns], x_m=-pose x[mm],heading_rad=4[deg]", kWanted, "--columns");
  ASSERT_TRUE(columns) << text(columns.error());
  EXPECT_EQ(columns->at(0).name, "stamp");
  EXPECT_EQ(columns->at(0).digits, 9);
  EXPECT_EQ(columns->at(1).name, "pose x");
  EXPECT_DOUBLE_EQ(columns->at(1).factor, -0.001);
  EXPECT_EQ(columns->at(2).name, "4");
  EXPECT_DOUBLE_EQ(columns->at(2).factor, std::numbers::pi / 180.0);
  EXPECT_EQ(columns->at(3).name, "kind");
  EXPECT_FALSE(columns->at(3).given);
}

TEST(Columns, TakeAFactorForAUnit) {
  const auto columns = parse_columns("x_m=ticks[0.0025]", kWanted, "--columns");
  ASSERT_TRUE(columns) << text(columns.error());
  EXPECT_DOUBLE_EQ(columns->at(1).factor, 0.0025);
}

TEST(Columns, OfOurOwnNamesNeedNoWord) {
  const auto columns = parse_columns("", kWanted, "--columns");
  ASSERT_TRUE(columns);
  EXPECT_EQ(columns->at(2).name, "heading_rad");
  EXPECT_EQ(columns->at(2).factor, 1.0);
}

TEST(Columns, AreRefusedWithTheirReasonAllAtOnce) {
  EXPECT_EQ(refusal("heading_rad=yaw[degree]"),
            "--columns heading_rad=yaw[degree]: unit \"degree\" must be one of rad, deg, or a number to multiply by\n");
  EXPECT_EQ(refusal("t_s=t[h]"), "--columns t_s=t[h]: unit \"h\" must be one of s, ms, us, ns\n");
  EXPECT_EQ(refusal("x_m=px[deg]"),
            "--columns x_m=px[deg]: unit \"deg\" must be one of m, cm, mm, km, or a number to multiply by\n");
  EXPECT_NE(refusal("heading_deg=yaw").find("did you mean heading_rad?"), std::string::npos);
  EXPECT_NE(refusal("x=px").find("\"x\" is not one of t_s, x_m, heading_rad, kind"), std::string::npos);
  EXPECT_NE(refusal("x_m").find("must have the form VALUE=COLUMN[UNIT]"), std::string::npos);
  EXPECT_NE(refusal("x_m=").find("must have the form VALUE=COLUMN[UNIT]"), std::string::npos);
  EXPECT_NE(refusal("x_m=a,x_m=b").find("names x_m twice"), std::string::npos);
  EXPECT_NE(refusal("t_s=-t").find("time runs forwards"), std::string::npos);
  EXPECT_NE(refusal("x_m=a[0]").find("unit \"0\""), std::string::npos);
  EXPECT_NE(refusal("x_m=a[nan]").find("unit \"nan\""), std::string::npos);
  const std::string both = refusal("x=1,y=2");
  EXPECT_EQ(std::count(both.begin(), both.end(), '\n'), 2) << both;
}

TEST(ForeignTime, LosesNoDigitInAnyUnit) {
  EXPECT_EQ(parse_time("1403636579763555584", 9), stamp_from_us(1'403'636'579'763'556));
  EXPECT_EQ(parse_time("1403636579763555", 6), stamp_from_us(1'403'636'579'763'555));
  EXPECT_EQ(parse_time("1500", 3), stamp_from_us(1'500'000));
  EXPECT_EQ(parse_time("1500.25", 3), stamp_from_us(1'500'250));
  EXPECT_EQ(parse_time("7", 9), stamp_from_us(0));
  EXPECT_EQ(parse_time("-1500", 6), stamp_from_us(-1'500));
  EXPECT_EQ(parse_time("1.5e3", 3), stamp_from_us(1'500'000));
  EXPECT_EQ(parse_time("1.5", 0), stamp_from_us(1'500'000));
}

TEST(ForeignTime, RefusesWhatIsNone) {
  for (const char* text : {"", "-", ".", ".5", "--5", "1-5", "1.2.3", "soon", "inf", "nan", "1e400", "0x10"})
    EXPECT_FALSE(parse_time(text, 3)) << text;
  EXPECT_FALSE(parse_time(std::string(40, '9'), 9));
}

}  // namespace
}  // namespace azimuth::test
