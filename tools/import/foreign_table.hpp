#pragma once
// Reads tables of other programs.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_result.hpp"
#include "slam/sample/stamp.hpp"
#include "tools/import/columns.hpp"

namespace azimuth {

/// Iterates over the rows of a table.
///
/// Separators are semicolons, commas or tabs, whichever the first row contains, otherwise blanks. A first line such as
/// `sep=;`, which spreadsheets write, sets the separator. Blanks and quotes around a field are ignored. Empty lines and
/// lines that begin with # are skipped. The first row contains the column names if it contains no number. Otherwise the
/// last comment line before it contains them if it has as many names as the row has fields. Each column can also be
/// addressed by its number. A unit in brackets after a column name, as in EuRoC data sets, is not part of the name; it
/// applies unless the user gave another unit. Errors are added to `errors`, and the iteration continues.
///
/// Borrows everything it is given. Thread contract: thread-bound.
class ForeignTable {
 public:
  /// `columns`: one for each of `wanted`, from parse_columns(). `option`: name of the option that assigns columns.
  ForeignTable(std::string_view text, std::span<const WantedColumn> wanted, std::span<const ForeignColumn> columns,
               std::string_view option, FileErrorList& errors);

  /// Goes to the next row of the right width. False at the end, or if a column is missing.
  bool next();
  void fail(std::string message) { errors_.add(line_, std::move(message)); }

  bool has(std::size_t column) const { return place_[column].has_value(); }
  /// Field of the present row; empty if the column is absent.
  std::string_view field(std::size_t column) const;

  /// Factor by which numbers of the column are multiplied; 1 if the column is absent.
  double factor(std::size_t column) const { return columns_[column].factor; }

  // Values of the present row. For an unreadable or implausible field, an error is added and the result is nothing.
  /// A stamp: a number in one or two columns, or a date and time in ISO 8601.
  std::optional<Stamp> stamp(std::size_t column);
  std::optional<double> number(std::size_t column, bool (*fits)(double));
  std::optional<std::int64_t> integer(std::size_t column, bool (*fits)(std::int64_t));

  enum class Order { later, same, earlier };
  /// Order of `stamp` relative to the row above. An earlier stamp adds an error.
  Order order(Stamp stamp);

  // Access to all columns of the table by index from 0, whether requested or not.
  std::size_t width() const { return width_; }
  std::string_view any_field(std::size_t place) const { return fields_[place]; }
  bool is_asked_for(std::size_t place) const;
  std::string name_of(std::size_t place) const;  ///< the name, or the number from 1 if there are no names

  int line() const { return line_; }
  /// Part of an error text: the names of the table's columns, or their number.
  std::string columns_there() const;

 private:
  std::optional<std::string_view> next_line();
  std::optional<std::string_view> next_row();
  void split(std::string_view line, char separator);
  void read_header();
  void find_columns();
  void take_separator();
  std::optional<std::size_t> place_of(std::string_view name) const;
  void take_unit_of_header(std::size_t column);
  std::optional<Stamp> stamp_of_two(std::size_t column);
  std::string missing(std::size_t column, std::string_view name) const;
  void fail_field(std::size_t column, const std::string& why);

  std::string_view rest_;
  std::span<const WantedColumn> wanted_;
  std::vector<ForeignColumn> columns_;
  std::string_view option_;
  FileErrorList& errors_;
  std::vector<std::optional<std::size_t>> place_;  // field index of each wanted column
  std::optional<std::size_t> rest_place_;          // field index of the second column of a stamp
  std::vector<std::string_view> names_, fields_;   // names_ is empty if the table has none
  std::string_view comment_;                       // the last comment before the first row
  std::optional<char> told_separator_;
  std::optional<std::string_view> first_row_;
  std::optional<Stamp> above_;
  char separator_ = ',';
  std::size_t width_ = 0;  // number of fields per row; 0 if the table is unreadable
  int line_ = 0;
};

/// Converts UTF-16, which some spreadsheets write, to UTF-8. Other text stays unchanged. Reentrant.
std::string in_utf8(std::string text);

/// Parses a date and time of day in ISO 8601, for example 2026-05-01T12:30:00.250Z. A blank may replace the T, and an
/// offset may replace the Z. Without either, the time is UTC. Nothing for other text. Reentrant.
std::optional<Stamp> parse_date(std::string_view text);

/// Parses a number as a time. The last `digits` digits before its decimal point are fractions of a second, 9 for
/// nanoseconds. The result is rounded to microseconds. Nothing if the text is no number or out of range. Reentrant.
std::optional<Stamp> parse_time(std::string_view text, int digits);

}  // namespace azimuth
