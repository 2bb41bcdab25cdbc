#include "drivers/storage/csv_reader.hpp"

#include <algorithm>
#include <cmath>

#include "drivers/wire/number_text.hpp"
#include "drivers/wire/text_lines.hpp"

namespace azimuth {

namespace {

std::string_view trimmed(std::string_view text, char separator) {
  const auto is_blank = [separator](char c) { return c == ' ' || (c == '\t' && c != separator); };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// The first of these characters in the header is the separator, because names of columns contain none of them.
char separator_of(std::string_view header) {
  for (const char separator : {',', ';', '\t'})
    if (header.find(separator) != std::string_view::npos) return separator;
  return ',';
}

std::string_view without_unit(std::string_view name) { return name.substr(0, name.rfind('_')); }
std::string unit_of(std::string_view name) { return std::string(name.substr(without_unit(name).size() + 1)); }

/// A hint at a likely mistake in a number; empty: none.
std::string misread_number(std::string_view text) {
  std::string with_point(text);
  std::ranges::replace(with_point, ',', '.');
  return parse_double(with_point) ? ": a decimal comma? Numbers take a point" : "";
}

/// A hint at degrees, for angles beyond a right angle; smaller values are out of range for another reason.
std::string misread_unit(std::string_view column, double value) {
  constexpr double kRightAngle_rad = 1.58;
  return column.ends_with("_rad") && std::abs(value) > kRightAngle_rad ? ": in degrees?" : "";
}

}  // namespace

CsvReader::CsvReader(std::string_view text, std::span<const CsvColumn> columns, FileErrorList& errors)
    : rest_(without_byte_order_mark(text)), columns_(columns), errors_(errors), place_(columns.size()) {
  read_header();
}

std::optional<std::string_view> CsvReader::next_line() {
  if (rest_.empty()) return std::nullopt;
  ++line_;
  return take_line(rest_);
}

void CsvReader::split(std::string_view line) {
  fields_.clear();
  for (std::size_t end = line.find(separator_); end != std::string_view::npos; end = line.find(separator_)) {
    fields_.push_back(trimmed(line.substr(0, end), separator_));
    line.remove_prefix(end + 1);
  }
  fields_.push_back(trimmed(line, separator_));
}

std::string CsvReader::unknown_column(std::string_view name) const {
  std::string message = "unknown column " + in_quotes(name);
  if (parse_double(name)) return message + ": the first line has to name the columns";
  for (const CsvColumn& known : columns_) {
    const bool has_unit = without_unit(known.name) != known.name;
    if (has_unit && (without_unit(name) == without_unit(known.name)))
      return message + "; the column is " + std::string(known.name) + ", in " + unit_of(known.name);
  }
  return message;
}

void CsvReader::read_header() {
  const std::optional<std::string_view> header = next_line();
  if (!header) return errors_.add(0, "is empty");
  separator_ = separator_of(*header);
  split(*header);
  const bool good_so_far = errors_.empty();
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const auto column = std::ranges::find(columns_, fields_[i], &CsvColumn::name);
    if (column == columns_.end()) {
      fail(unknown_column(fields_[i]));
    } else if (auto& place = place_[static_cast<std::size_t>(column - columns_.begin())]; place) {
      fail("column " + std::string(column->name) + " is repeated");
    } else {
      place = i;
    }
  }
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].required && !place_[i]) fail("missing column " + std::string(columns_[i].name));
  }
  if (good_so_far && errors_.empty()) width_ = fields_.size();
}

bool CsvReader::next() {
  if (width_ == 0) return false;
  while (const std::optional<std::string_view> line = next_line()) {
    split(*line);
    if (fields_.size() == width_) return true;
    const std::string counts =
        "expected " + std::to_string(width_) + " fields, found " + std::to_string(fields_.size());
    const bool is_split_twice = separator_ == ',' && fields_.size() > width_;
    fail(line->empty() ? "empty line" : counts + (is_split_twice ? ": decimal commas? Numbers take a point" : ""));
  }
  return false;
}

std::string_view CsvReader::field(std::size_t column) const {
  return place_[column] ? fields_[*place_[column]] : std::string_view{};
}

void CsvReader::fail_field(std::size_t column, std::string_view why) {
  const std::string_view text = field(column);
  fail(std::string(columns_[column].name) + ' ' +
       (text.empty() ? "is empty" : in_quotes(text) + ' ' + std::string(why)));
}

std::optional<Stamp> CsvReader::seconds(std::size_t column) {
  if (!has(column)) return std::nullopt;
  const std::optional<Stamp> stamp = parse_seconds(field(column));
  if (!stamp) fail_field(column, "is not a time in seconds, or out of range" + misread_number(field(column)));
  return stamp;
}

std::optional<std::int64_t> CsvReader::integer(std::size_t column, bool (*is_plausible)(std::int64_t)) {
  if (!has(column)) return std::nullopt;
  const std::optional<std::int64_t> value = parse_integer(field(column));
  if (value && is_plausible(*value)) return value;
  fail_field(column, value ? "is out of range" : "is not a whole number");
  return std::nullopt;
}

std::optional<double> CsvReader::number(std::size_t column, bool (*is_plausible)(double)) {
  if (!has(column)) return std::nullopt;
  const std::optional<double> value = parse_double(field(column));
  if (value && is_plausible(*value)) return value;
  if (!value)
    fail_field(column, "is not a number" + misread_number(field(column)));
  else
    fail_field(column, std::isfinite(*value) ? "is out of range" + misread_unit(columns_[column].name, *value)
                                             : "is not finite");
  return std::nullopt;
}

}  // namespace azimuth
