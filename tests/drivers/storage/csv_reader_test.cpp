#include "drivers/storage/csv_reader.hpp"

#include <cmath>
#include <gmock/gmock.h>

namespace azimuth {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr CsvColumn kColumns[] = {{"a"}, {"b"}, {"note", false}};

struct Read {
  std::vector<std::string> errors;
  std::vector<std::string> rows;  // format: a|b|note
};

Read read(std::string_view text) {
  FileErrorList errors("t.csv");
  CsvReader reader(text, kColumns, errors);
  Read result;
  while (reader.next()) {
    result.rows.push_back(std::string(reader.field(0)) + '|' + std::string(reader.field(1)) + '|' +
                          std::string(reader.field(2)));
  }
  FileErrors all;
  std::move(errors).move_to(all);
  for (const FileError& error : all) result.errors.push_back(error.text());
  return result;
}

TEST(CsvReader, ReadsRows) {
  const Read result = read("a,b,note\n1,2,x\n3,4,\n");
  EXPECT_THAT(result.errors, IsEmpty());
  EXPECT_THAT(result.rows, ElementsAre("1|2|x", "3|4|"));
}

TEST(CsvReader, ColumnsMayStandInAnyOrder) {
  EXPECT_THAT(read("note,b,a\nx,2,1\n").rows, ElementsAre("1|2|x"));
  EXPECT_THAT(read("b,a\n2,1\n").rows, ElementsAre("1|2|"));
}

TEST(CsvReader, AcceptsCrlfByteOrderMarkAndMissingLastLineEnd) {
  const Read result = read(
      "\xEF\xBB\xBF"
      "a,b\r\n1,2\r\n3,4");
  EXPECT_THAT(result.errors, IsEmpty());
  EXPECT_THAT(result.rows, ElementsAre("1|2|", "3|4|"));
}

TEST(CsvReader, NamesEveryWrongColumn) {
  const Read result = read("a,c,a,\n1,2,3,4\n");
  EXPECT_THAT(result.rows, IsEmpty());
  EXPECT_THAT(result.errors, ElementsAre("t.csv:1: unknown column \"c\"", "t.csv:1: column a is repeated",
                                         "t.csv:1: unknown column \"\"", "t.csv:1: missing column b"));
}

TEST(CsvReader, ColumnNamesAreExact) {
  EXPECT_THAT(read("a,b2\n1,2\n").errors, ElementsAre("t.csv:1: unknown column \"b2\"", "t.csv:1: missing column b"));
  EXPECT_THAT(read("A,b\n1,2\n").errors, ElementsAre("t.csv:1: unknown column \"A\"", "t.csv:1: missing column a"));
}

TEST(CsvReader, PassesOverBlanksAroundFields) {
  const Read result = read("a, b ,note\n 1,\t2, x y \n");
  EXPECT_THAT(result.errors, IsEmpty());
  EXPECT_THAT(result.rows, ElementsAre("1|2|x y"));
}

TEST(CsvReader, SemicolonsAndTabsSeparateWhereTheHeaderHasNoComma) {
  EXPECT_THAT(read("a;b;note\n1;2;x,y\n").rows, ElementsAre("1|2|x,y"));
  EXPECT_THAT(read("a\tb\tnote\n1\t2\t\n3\t 4\tx\n").rows, ElementsAre("1|2|", "3|4|x"));
  EXPECT_THAT(read("a,b\n1;2\n").errors, ElementsAre("t.csv:2: expected 2 fields, found 1"));
}

TEST(CsvReader, NamesTheUnitOfAColumnThatIsKnownByAnother) {
  constexpr CsvColumn kWithUnits[] = {{"t_s"}, {"heading_rad"}};
  FileErrorList errors("t.csv");
  CsvReader reader("t_ms,heading_deg\n", kWithUnits, errors);
  FileErrors all;
  std::move(errors).move_to(all);
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[0].message, "unknown column \"t_ms\"; the column is t_s, in s");
  EXPECT_EQ(all[1].message, "unknown column \"heading_deg\"; the column is heading_rad, in rad");
}

TEST(CsvReader, SaysThatTheNamesOfTheColumnsAreMissing) {
  EXPECT_THAT(read("1.5,2\n3,4\n").errors,
              ElementsAre("t.csv:1: unknown column \"1.5\": the first line has to name the columns",
                          "t.csv:1: unknown column \"2\": the first line has to name the columns",
                          "t.csv:1: missing column a", "t.csv:1: missing column b"));
}

TEST(CsvReader, NamesDecimalCommasAndDegrees) {
  constexpr CsvColumn kAngle[] = {{"t_s"}, {"azimuth_rad"}};
  FileErrorList errors("t.csv");
  CsvReader reader("t_s;azimuth_rad\n0,5;1,5\n1;170\n", kAngle, errors);
  while (reader.next()) {
    reader.seconds(0);
    reader.number(1, [](double value) { return std::abs(value) < 7.0; });
  }
  FileErrors all;
  std::move(errors).move_to(all);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].message,
            "t_s \"0,5\" is not a time in seconds, or out of range: a decimal comma? Numbers take a point");
  EXPECT_EQ(all[1].message, "azimuth_rad \"1,5\" is not a number: a decimal comma? Numbers take a point");
  EXPECT_EQ(all[2].message, "azimuth_rad \"170\" is out of range: in degrees?");
}

TEST(CsvReader, NamesRowsOfAnotherWidthAndGoesOn) {
  const Read result = read("a,b\n1\n1,2\n\n1,2,3\n4,5\n");
  EXPECT_THAT(result.rows, ElementsAre("1|2|", "4|5|"));
  EXPECT_THAT(result.errors, ElementsAre("t.csv:2: expected 2 fields, found 1", "t.csv:4: empty line",
                                         "t.csv:5: expected 2 fields, found 3: decimal commas? Numbers take a point"));
}

TEST(CsvReader, EmptyTextIsAnError) {
  EXPECT_THAT(read("").errors, ElementsAre("t.csv: is empty"));
  EXPECT_THAT(read("\xEF\xBB\xBF").errors, ElementsAre("t.csv: is empty"));
}

TEST(CsvReader, ListsTwentyErrorsAndCountsTheRest) {
  std::string text = "a,b\n";
  for (int i = 0; i < 25; ++i) text += "1\n";
  const Read result = read(text);
  ASSERT_EQ(result.errors.size(), FileErrorList::kMost + 1);
  EXPECT_EQ(result.errors.back(), "t.csv: and 5 more errors");
}

TEST(CsvReader, SaysWhatIsWrongWithAValue) {
  FileErrorList errors("t.csv");
  CsvReader reader("a,b\nx,\nnan,inf\n11,-1\n1.5,1e999\n", kColumns, errors);
  const auto small = [](double value) { return std::abs(value) < 10.0; };
  const auto positive = [](std::int64_t value) { return value > 0; };
  while (reader.next()) {
    reader.number(0, small);
    reader.integer(1, positive);
  }
  FileErrors all;
  std::move(errors).move_to(all);
  EXPECT_EQ(text(all),
            "t.csv:2: a \"x\" is not a number\n"
            "t.csv:2: b is empty\n"
            "t.csv:3: a \"nan\" is not finite\n"
            "t.csv:3: b \"inf\" is not a whole number\n"
            "t.csv:4: a \"11\" is out of range\n"
            "t.csv:4: b \"-1\" is out of range\n"
            "t.csv:5: b \"1e999\" is not a whole number\n");
}

TEST(CsvReader, MessagesAreFitForATerminal) {
  const Read result = read(std::string("\x1B[31m,b\n") + std::string(100, 'x'));
  ASSERT_EQ(result.errors.size(), 2U);
  EXPECT_EQ(result.errors[0], "t.csv:1: unknown column \"\\x1b[31m\"");
  FileErrorList errors("t.csv");
  const std::string text = "a,b\n1," + std::string(100, 'y') + "\n";
  CsvReader reader(text, kColumns, errors);
  ASSERT_TRUE(reader.next());
  reader.seconds(1);
  FileErrors all;
  std::move(errors).move_to(all);
  EXPECT_EQ(all.front().message, "b \"" + std::string(40, 'y') + "...\" is not a time in seconds, or out of range");
}

}  // namespace
}  // namespace azimuth
