#include "drivers/io/csv_reader.hpp"

#include <algorithm>
#include <cmath>

#include "drivers/io/number_text.hpp"

namespace azimuth {

namespace {

/// Text of a file as it may be shown on a terminal.
std::string quoted(std::string_view text) {
  constexpr std::size_t kMaxShown = 40;
  std::string shown = "\"";
  for (const char c : text.substr(0, kMaxShown)) shown += c >= ' ' && c <= '~' ? c : '?';
  return shown + (text.size() > kMaxShown ? "...\"" : "\"");
}

}  // namespace

CsvReader::CsvReader(std::string_view text, std::span<const CsvColumn> columns, FileErrorList& errors)
    : rest_(text), columns_(columns), errors_(errors), place_(columns.size()) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
  read_header();
}

std::optional<std::string_view> CsvReader::next_line() {
  if (rest_.empty()) return std::nullopt;
  const std::size_t length = std::min(rest_.find('\n'), rest_.size());
  std::string_view line = rest_.substr(0, length);
  rest_.remove_prefix(std::min(length + 1, rest_.size()));
  if (line.ends_with('\r')) line.remove_suffix(1);
  ++line_;
  return line;
}

void CsvReader::split(std::string_view line) {
  fields_.clear();
  for (std::size_t comma = line.find(','); comma != std::string_view::npos; comma = line.find(',')) {
    fields_.push_back(line.substr(0, comma));
    line.remove_prefix(comma + 1);
  }
  fields_.push_back(line);
}

void CsvReader::read_header() {
  const std::optional<std::string_view> header = next_line();
  if (!header) return errors_.add(0, "is empty");
  split(*header);
  const bool good_so_far = errors_.empty();
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    const auto column = std::ranges::find(columns_, fields_[i], &CsvColumn::name);
    if (column == columns_.end()) {
      fail("unknown column " + quoted(fields_[i]));
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
    fail(line->empty() ? "empty line"
                       : "expected " + std::to_string(width_) + " fields, found " + std::to_string(fields_.size()));
  }
  return false;
}

std::string_view CsvReader::field(std::size_t column) const {
  return place_[column] ? fields_[*place_[column]] : std::string_view{};
}

void CsvReader::fail_field(std::size_t column, std::string_view why) {
  const std::string_view text = field(column);
  fail(std::string(columns_[column].name) + ' ' + (text.empty() ? "is empty" : quoted(text) + ' ' + std::string(why)));
}

std::optional<Stamp> CsvReader::seconds(std::size_t column) {
  if (!has(column)) return std::nullopt;
  const std::optional<Stamp> stamp = parse_seconds(field(column));
  if (!stamp) fail_field(column, "is not a time in seconds, or out of range");
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
  fail_field(column, !value ? "is not a number" : std::isfinite(*value) ? "is out of range" : "is not finite");
  return std::nullopt;
}

}  // namespace azimuth
