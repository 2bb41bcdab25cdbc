#pragma once
// Strict tables: one header line, then rows with the same number of fields. Internal to drivers/storage.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_result.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

struct CsvColumn {
  std::string_view name;
  bool required = true;
};

/// Reads the rows of a table. Columns may be in any order. Unknown, missing and repeated columns are errors, and so are
/// rows with too few or too many fields. Fields are separated by commas, or by semicolons or tabs if the header has no
/// comma. Blanks around fields are ignored, and there is no quoting. Lines end with LF or CRLF; a byte order mark is
/// ignored. Every error goes to `errors` with its likely cause, and reading continues.
///
/// Borrows all its arguments. Thread contract: thread-bound.
class CsvReader {
 public:
  CsvReader(std::string_view text, std::span<const CsvColumn> columns, FileErrorList& errors);

  /// Goes to the next row with the right number of fields. False at the end, or when the header is wrong.
  bool next();

  int line() const { return line_; }
  void fail(std::string message) { errors_.add(line_, std::move(message)); }

  // The functions below read the current row by the column's index in `columns`. A field that cannot be read, or is
  // implausible, is reported as an error and gives none. An absent column gives none without an error.
  bool has(std::size_t column) const { return place_[column].has_value(); }
  std::string_view field(std::size_t column) const;  ///< empty when the column is absent
  std::optional<Stamp> seconds(std::size_t column);
  std::optional<std::int64_t> integer(std::size_t column, bool (*is_plausible)(std::int64_t));
  std::optional<double> number(std::size_t column, bool (*is_plausible)(double));

 private:
  std::optional<std::string_view> next_line();
  void read_header();
  void split(std::string_view line);
  std::string unknown_column(std::string_view name) const;
  void fail_field(std::size_t column, std::string_view why);

  std::string_view rest_;
  std::span<const CsvColumn> columns_;
  FileErrorList& errors_;
  std::vector<std::optional<std::size_t>> place_;  // position of each column among the fields
  std::vector<std::string_view> fields_;
  char separator_ = ',';
  std::size_t width_ = 0;  // number of fields in the header; 0: the header is wrong
  int line_ = 0;
};

}  // namespace azimuth
