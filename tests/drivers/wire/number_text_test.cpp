#include "drivers/wire/number_text.hpp"

#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "drivers/wire/plausible.hpp"

namespace azimuth {
namespace {

std::optional<std::int64_t> microseconds(std::string_view text) {
  const auto stamp = parse_seconds(text);
  return stamp ? std::optional(to_us(*stamp)) : std::nullopt;
}

TEST(Seconds, AreExactToTheMicrosecond) {
  EXPECT_EQ(microseconds("0"), 0);
  EXPECT_EQ(microseconds("0.000001"), 1);
  EXPECT_EQ(microseconds("-0.000001"), -1);
  EXPECT_EQ(microseconds("1.1"), 1'100'000);
  EXPECT_EQ(microseconds("1700000000.123457"), 1'700'000'000'123'457);
  EXPECT_EQ(microseconds(".5"), 500'000);
  EXPECT_EQ(microseconds("7."), 7'000'000);
}

TEST(Seconds, FurtherDecimalsAreRounded) {
  EXPECT_EQ(microseconds("0.0000004"), 0);
  EXPECT_EQ(microseconds("0.0000005"), 1);
  EXPECT_EQ(microseconds("0.9999999999"), 1'000'000);
  EXPECT_EQ(microseconds("-0.0000005"), -1);
}

TEST(Seconds, MayBeScientific) {
  EXPECT_EQ(microseconds("1e3"), 1'000'000'000);
  EXPECT_EQ(microseconds("2.5000000000000000e-01"), 250'000);
}

TEST(Seconds, RefuseWhatIsNoPlausibleTime) {
  for (const char* text : {"",
                           "-",
                           ".",
                           "abc",
                           "1,5",
                           "1.5s",
                           " 1",
                           "1 ",
                           "+1",
                           "--1",
                           "1.-5",
                           "1.2.3",
                           "nan",
                           "inf",
                           "0x10",
                           "4000000000000",
                           "99999999999999999999999",
                           "1e300",
                           "-1e13",
                           "1e",
                           "nane"}) {
    EXPECT_FALSE(parse_seconds(text)) << text;
  }
}

RC_GTEST_PROP(Seconds, ComeBackEqual, (std::int64_t bits)) {
  const Stamp stamp = stamp_from_us(bits % kMaxStamp_us);
  std::string text;
  append_seconds(text, stamp);
  RC_ASSERT(parse_seconds(text) == stamp);
}

RC_GTEST_PROP(Doubles, ComeBackBitForBit, (std::uint64_t bits)) {
  const double value = std::bit_cast<double>(bits);
  RC_PRE(std::isfinite(value));
  std::string text;
  append_double(text, value);
  RC_ASSERT(parse_double(text).has_value());
  RC_ASSERT(std::bit_cast<std::uint64_t>(*parse_double(text)) == bits);
}

TEST(Doubles, RefuseWhatIsNotWhollyANumber) {
  for (const char* text : {"", "abc", "1.0x", " 1", "1 ", "+1", "1,0", "1e999", "0x1p3"}) {
    EXPECT_FALSE(parse_double(text)) << text;
  }
}

TEST(Integers, RefuseFractionsAndOverflow) {
  EXPECT_EQ(parse_integer("-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
  for (const char* text : {"", "1.0", "9223372036854775808", "1e3", "-", "0x1"})
    EXPECT_FALSE(parse_integer(text)) << text;
}

}  // namespace
}  // namespace azimuth
