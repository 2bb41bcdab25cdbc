#pragma once
// Tables as other programs write them.

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

/// Walks the rows of a table. Fields are separated by semicolons, commas or tabs, whichever the first row has, else by
/// blanks; `sep=;` as the first line, which spreadsheets write, says which. Those round a field and its quotes are
/// passed over, and so are empty lines and lines that begin with #. The first row names the columns when it holds no
/// number; else the last line with a # before it, when that has as many names; and any column goes by its number. A
/// unit in brackets behind a name, as of EuRoC, is no part of it, and holds unless another was given. Whatever is wrong
/// goes to `errors`, and the walk continues.
///
/// Borrows everything it is given. Thread contract: thread-bound.
class ForeignTable {
 public:
  /// `columns`: one for each of `wanted`, as parse_columns() gives them. `option` is what says which is which.
  ForeignTable(std::string_view text, std::span<const WantedColumn> wanted, std::span<const ForeignColumn> columns,
               std::string_view option, FileErrorList& errors);

  /// Goes to the next row of the right width; false at the end, or when a column is missing.
  bool next();
  void fail(std::string message) { errors_.add(line_, std::move(message)); }

  bool has(std::size_t column) const { return place_[column].has_value(); }
  /// Of the present row; empty when the column is absent.
  std::string_view field(std::size_t column) const;

  /// What a number in the table was multiplied by, 1 when the column is absent.
  double factor(std::size_t column) const { return columns_[column].factor; }

  // Of the present row. What cannot be read, or is not plausible, is an error and nothing.
  /// A number, of two columns perhaps, or a date and time as ISO 8601 has them.
  std::optional<Stamp> stamp(std::size_t column);
  std::optional<double> number(std::size_t column, bool (*fits)(double));
  std::optional<std::int64_t> integer(std::size_t column, bool (*fits)(std::int64_t));

  enum class Order { later, same, earlier };
  /// Of `stamp` and that of the row above; an earlier one is an error.
  Order order(Stamp stamp);

  // Of all columns, from 0, asked for or not.
  std::size_t width() const { return width_; }
  std::string_view any_field(std::size_t place) const { return fields_[place]; }
  bool is_asked_for(std::size_t place) const;
  std::string name_of(std::size_t place) const;  ///< or its number from 1

  int line() const { return line_; }
  /// The names of its columns, or how many there are, for a sentence.
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
  std::vector<std::optional<std::size_t>> place_;  // of each column among the fields
  std::optional<std::size_t> rest_place_;          // of the second column of a stamp
  std::vector<std::string_view> names_, fields_;   // names: empty when there are none
  std::string_view comment_;                       // the last one above the first row
  std::optional<char> told_separator_;
  std::optional<std::string_view> first_row_;
  std::optional<Stamp> above_;
  char separator_ = ',';
  std::size_t width_ = 0;  // 0: nothing can be read
  int line_ = 0;
};

/// UTF-16, which some spreadsheets write, as UTF-8; any other text as it is. Reentrant.
std::string in_utf8(std::string text);

/// A date and a time of day as ISO 8601 has them, 2026-05-01T12:30:00.250Z, a blank in place of the T, an offset in
/// place of the Z; without either it is taken for UTC. Nothing for any other text. Reentrant.
std::optional<Stamp> parse_date(std::string_view text);

/// The time that a number stands for, the last `digits` before its point being fractions of a second: 9 of nanoseconds;
/// to the nearest microsecond. Nothing when it is none, or out of range. Reentrant.
std::optional<Stamp> parse_time(std::string_view text, int digits);

}  // namespace azimuth
