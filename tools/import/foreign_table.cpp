#include "tools/import/foreign_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drivers/wire/number_text.hpp"
#include "drivers/wire/text_lines.hpp"
#include "settings/suggestion.hpp"

namespace azimuth {
namespace {

constexpr char kBlanks = ' ';  // as a separator: any number of blanks and tabs
constexpr std::size_t kMostNames = 20;

bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string_view stripped(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Without the quotes that spreadsheets put round it.
std::string_view bare(std::string_view field) {
  field = stripped(field);
  const bool is_quoted = field.size() >= 2 && field.front() == '"' && field.back() == '"';
  return is_quoted ? stripped(field.substr(1, field.size() - 2)) : field;
}

/// printf's %+f is read as well.
std::string_view without_plus(std::string_view number) {
  if (number.starts_with('+') && !number.starts_with("+-")) number.remove_prefix(1);
  return number;
}

char separator_in(std::string_view row) {
  for (const char separator : {';', ',', '\t'})
    if (row.find(separator) != std::string_view::npos) return separator;
  return kBlanks;
}

bool is_number(std::string_view field) { return parse_double(without_plus(field)).has_value(); }

/// What may have been meant by something that is no number.
std::string decimal_comma(std::string_view text) {
  std::string with_point(text);
  std::ranges::replace(with_point, ',', '.');
  return is_number(with_point) ? ": a decimal comma? Numbers take a point" : "";
}

}  // namespace

ForeignTable::ForeignTable(std::string_view text, std::span<const WantedColumn> wanted,
                           std::span<const ForeignColumn> columns, std::string_view option, FileErrorList& errors)
    : rest_(without_byte_order_mark(text)),
      wanted_(wanted),
      columns_(columns),
      option_(option),
      errors_(errors),
      place_(wanted.size()) {
  read_header();
}

std::optional<std::string_view> ForeignTable::next_line() {
  if (rest_.empty()) return std::nullopt;
  ++line_;
  return take_line(rest_);
}

/// Past empty lines and comments, of which the last one is kept.
std::optional<std::string_view> ForeignTable::next_row() {
  while (const std::optional<std::string_view> line = next_line()) {
    const std::string_view content = stripped(*line);
    if (content.empty()) continue;
    if (!content.starts_with('#')) return line;
    comment_ = content.substr(1);
  }
  return std::nullopt;
}

void ForeignTable::split(std::string_view line, char separator) {
  fields_.clear();
  if (separator == kBlanks) {
    for (line = stripped(line); !line.empty(); line = stripped(line)) {
      const auto end = static_cast<std::size_t>(std::ranges::find_if(line, is_blank) - line.begin());
      fields_.push_back(bare(line.substr(0, end)));
      line.remove_prefix(end);
    }
    return;
  }
  for (std::size_t end = line.find(separator); end != std::string_view::npos; end = line.find(separator)) {
    fields_.push_back(bare(line.substr(0, end)));
    line.remove_prefix(end + 1);
  }
  fields_.push_back(bare(line));
}

void ForeignTable::read_header() {
  const std::optional<std::string_view> row = next_row();
  if (!row) return errors_.add(0, "has no rows");
  separator_ = separator_in(*row);
  split(*row, separator_);
  const std::size_t width = fields_.size();
  const bool is_header = std::ranges::none_of(fields_, is_number);
  if (!is_header) {
    first_row_ = row;
    split(comment_, separator_in(comment_));
    if (fields_.size() != width) fields_.clear();
  }
  names_ = fields_;
  fields_.resize(width);
  find_columns();
  if (errors_.empty()) width_ = width;
}

void ForeignTable::find_columns() {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const ForeignColumn& column = columns_[i];
    const auto named = std::ranges::find(names_, column.name);
    const auto number = static_cast<std::size_t>(std::max<std::int64_t>(0, parse_integer(column.name).value_or(0)));
    if (named != names_.end()) {
      place_[i] = static_cast<std::size_t>(named - names_.begin());
    } else if (number >= 1 && number <= fields_.size()) {
      place_[i] = number - 1;
    } else if (column.given || wanted_[i].required) {
      errors_.add(line_, missing(i));
    }
  }
}

std::string ForeignTable::columns_there() const {
  if (names_.empty()) return "there are " + std::to_string(fields_.size()) + " without names";
  std::string list;
  for (std::size_t i = 0; i < std::min(names_.size(), kMostNames); ++i)
    list += (i > 0 ? ", " : "") + printable(names_[i]);
  return "there are " + list + (names_.size() > kMostNames ? ", ..." : "");
}

std::string ForeignTable::missing(std::size_t column) const {
  const std::string& name = columns_[column].name;
  const std::string said = "has no column " + in_quotes(name);
  const auto meant = nearest(name, names_);
  if (meant && columns_[column].given) return said + "; did you mean " + in_quotes(*meant) + '?';
  const std::string how =
      std::string(option_) + ' ' + std::string(wanted_[column].name) + '=' + (names_.empty() ? "1" : "NAME");
  return said + "; " + columns_there() + ": say which it is, such as " + how;
}

bool ForeignTable::next() {
  if (width_ == 0) return false;
  if (first_row_) {
    split(*first_row_, separator_);
    first_row_.reset();
    return true;
  }
  while (const std::optional<std::string_view> row = next_row()) {
    split(*row, separator_);
    if (fields_.size() == width_) return true;
    const bool is_split_twice = separator_ == ',' && fields_.size() > width_;
    fail("expected " + std::to_string(width_) + " fields, found " + std::to_string(fields_.size()) +
         (is_split_twice ? ": decimal commas? Numbers take a point" : ""));
  }
  return false;
}

std::string_view ForeignTable::field(std::size_t column) const {
  return place_[column] ? fields_[*place_[column]] : std::string_view{};
}

void ForeignTable::fail_field(std::size_t column, const std::string& why) {
  const std::string& name = columns_[column].name;
  const std::string_view text = field(column);
  const std::string what = parse_integer(name) ? "column " + name : printable(name);
  fail(what + ' ' + (text.empty() ? "is empty" : in_quotes(text) + ' ' + why));
}

std::optional<Stamp> ForeignTable::stamp(std::size_t column) {
  const std::string& unit = columns_[column].unit;
  const std::optional<Stamp> stamp = parse_time(without_plus(field(column)), columns_[column].digits);
  if (!stamp)
    fail_field(column,
               "is not a time in " + (unit.empty() ? "s" : unit) + ", or out of range" + decimal_comma(field(column)));
  return stamp;
}

std::optional<double> ForeignTable::number(std::size_t column, bool (*fits)(double)) {
  const std::optional<double> written = parse_double(without_plus(field(column)));
  if (!written) {
    fail_field(column, "is not a number" + decimal_comma(field(column)));
    return std::nullopt;
  }
  const double value = *written * columns_[column].factor;
  if (fits(value)) return value;
  const std::string_view wanted = wanted_[column].name;
  const bool may_be_degrees = wanted.ends_with("_rad") && columns_[column].unit.empty() && std::isfinite(value);
  const std::string question =
      ": in degrees? " + std::string(wanted) + '=' + printable(columns_[column].name) + "[deg] says so";
  fail_field(column, !std::isfinite(value) ? "is not finite" : "is out of range" + (may_be_degrees ? question : ""));
  return std::nullopt;
}

std::optional<std::int64_t> ForeignTable::integer(std::size_t column, bool (*fits)(std::int64_t)) {
  const std::optional<std::int64_t> value = parse_integer(without_plus(field(column)));
  if (value && fits(*value)) return value;
  fail_field(column, value ? "is out of range" : "is not a whole number");
  return std::nullopt;
}

ForeignTable::Order ForeignTable::order(Stamp stamp) {
  const std::optional<Stamp> above = std::exchange(above_, stamp);
  if (!above || stamp > *above) return Order::later;
  if (stamp == *above) return Order::same;
  fail("t_s is earlier than in the row above");
  return Order::earlier;
}

std::optional<Stamp> parse_time(std::string_view text, int digits) {
  if (digits == 0) return parse_seconds(text);
  std::string seconds;
  if (text.find_first_of("eE") != std::string_view::npos) {
    const std::optional<double> value = parse_double(text);
    if (!value) return std::nullopt;
    append_double(seconds, *value * std::pow(10.0, -digits));
    return parse_seconds(seconds);
  }
  if (text.starts_with('-')) {
    seconds = "-";
    text.remove_prefix(1);
  }
  const std::size_t point = std::min(text.find('.'), text.size());
  const std::string_view fraction = point < text.size() ? text.substr(point + 1) : std::string_view{};
  if (point == 0) return std::nullopt;
  // The point moves, so that no digit of 19 is lost to a double.
  const auto shift = static_cast<std::size_t>(digits);
  std::string whole(text.substr(0, point));
  if (whole.size() <= shift) whole.insert(0, shift + 1 - whole.size(), '0');
  seconds.append(whole, 0, whole.size() - shift).append(1, '.').append(whole, whole.size() - shift).append(fraction);
  return parse_seconds(seconds);
}

}  // namespace azimuth
