#include "base/visible.hpp"

#include <gtest/gtest.h>

#include "base/file_result.hpp"

namespace azimuth {
namespace {

TEST(Visible, WhatPeopleReadStaysAsItIs) {
  for (const char* text : {"", "run 7/odometry.csv", "Gänge_日本.bag", "\\n", "a \xf0\x9f\xa4\x96"})
    EXPECT_EQ(visible(text), text);
}

TEST(Visible, ControlCharactersAreShown) {
  EXPECT_EQ(visible("a\nb\tc\rd"), "a\\nb\\tc\\rd");
  EXPECT_EQ(visible("\x1b[2J\x07\x7f"), "\\x1b[2J\\x07\\x7f");
  EXPECT_EQ(visible(std::string_view("\0", 1)), "\\x00");
  EXPECT_EQ(visible("\xc2\x9b"
                    "31m"),
            "\\u009b31m")
      << "CSI in eight bits";
}

TEST(Visible, WhatTurnsOrHidesTextIsShown) {
  EXPECT_EQ(visible("a\xe2\x80\xae"
                    "b"),
            "a\\u202eb");
  EXPECT_EQ(visible("\xe2\x81\xa6\xe2\x80\x8b\xef\xbb\xbf"), "\\u2066\\u200b\\ufeff");
  EXPECT_EQ(visible("\xe2\x80\xa8"), "\\u2028") << "a line end, too";
}

TEST(Visible, BytesThatAreNoTextAreShown) {
  EXPECT_EQ(visible("\xff"), "\\xff");
  EXPECT_EQ(visible("\x9b"), "\\x9b") << "CSI where a terminal knows no UTF-8";
  EXPECT_EQ(visible("\xc3"), "\\xc3") << "cut";
  EXPECT_EQ(visible("\xe2\x82 "), "\\xe2\\x82 ") << "cut in the midst";
  EXPECT_EQ(visible("\xc1\x8a"), "\\xc1\\x8a") << "a line end, written too long";
  EXPECT_EQ(visible("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half a pair of UTF-16";
  EXPECT_EQ(visible("\xf8\x88\x80\x80\x80"), "\\xf8\\x88\\x80\\x80\\x80");
}

TEST(Visible, LinesOfOursStayLines) {
  EXPECT_EQ(visible_lines("a\n\x1b"
                          "b\r\n"),
            "a\n\\x1bb\\r\n");
}

TEST(Visible, AnErrorIsOneLine) {
  EXPECT_EQ((FileError{"a\nb", 3, "is \x1b[1mbad"}.text()), "a\\nb:3: is \\x1b[1mbad");
}

}  // namespace
}  // namespace azimuth
