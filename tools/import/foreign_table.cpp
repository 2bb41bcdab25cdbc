#include "tools/import/foreign_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drivers/wire/number_text.hpp"
#include "drivers/wire/plausible.hpp"
#include "drivers/wire/text_lines.hpp"
#include "settings/suggestion.hpp"

namespace azimuth {
namespace {

constexpr char kBlanks = ' ';  // this separator means any number of blanks and tabs
constexpr std::size_t kMostNames = 20;

bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string_view stripped(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// The field without the quotes that spreadsheets put around it.
std::string_view bare(std::string_view field) {
  field = stripped(field);
  const bool is_quoted = field.size() >= 2 && field.front() == '"' && field.back() == '"';
  return is_quoted ? stripped(field.substr(1, field.size() - 2)) : field;
}

/// Removes a plus sign, as printf writes it for %+f.
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

/// The two parts of a header field such as "timestamp [ns]".
struct NameAndUnit {
  std::string_view name, unit;
};
NameAndUnit parted(std::string_view header) {
  const std::size_t bracket = header.rfind('[');
  if (!header.ends_with(']') || bracket == std::string_view::npos) return {header, {}};
  return {stripped(header.substr(0, bracket)), stripped(header.substr(bracket + 1, header.size() - bracket - 2))};
}

/// A hint for an invalid number that may contain a decimal comma.
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
      columns_(columns.begin(), columns.end()),
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

/// The next row after empty lines and comments. Stores the last comment.
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

/// Reads the first line `sep=;` of a spreadsheet.
void ForeignTable::take_separator() {
  constexpr std::string_view kSeparator = "sep=";
  std::string_view rest = rest_;
  const std::string_view line = rest.empty() ? std::string_view{} : bare(take_line(rest));
  if (line.size() != kSeparator.size() + 1 || !line.starts_with(kSeparator)) return;
  told_separator_ = line.back();
  next_line();
}

void ForeignTable::read_header() {
  take_separator();
  const std::optional<std::string_view> row = next_row();
  if (!row) return errors_.add(0, "has no rows");
  separator_ = told_separator_.value_or(separator_in(*row));
  split(*row, separator_);
  const std::size_t width = fields_.size();
  const bool is_header = std::ranges::none_of(fields_, is_number);
  if (!is_header) {
    first_row_ = row;
    split(comment_, told_separator_.value_or(separator_in(comment_)));
    if (fields_.size() != width) fields_.clear();
  }
  names_ = fields_;
  fields_.resize(width);
  find_columns();
  if (errors_.empty()) width_ = width;
}

/// Finds a column by its name with the unit, by its name without the unit, or by its number.
std::optional<std::size_t> ForeignTable::place_of(std::string_view name) const {
  auto named = std::ranges::find(names_, name);
  if (named == names_.end()) named = std::ranges::find(names_, name, [](auto each) { return parted(each).name; });
  if (named != names_.end()) return static_cast<std::size_t>(named - names_.begin());
  const auto number = static_cast<std::size_t>(std::max<std::int64_t>(0, parse_integer(name).value_or(0)));
  return number >= 1 && number <= fields_.size() ? std::optional(number - 1) : std::nullopt;
}

void ForeignTable::take_unit_of_header(std::size_t column) {
  const std::optional<std::size_t> place = place_[column];
  if (place && *place < names_.size() && columns_[column].unit.empty() && columns_[column].rest.empty())
    take_unit(wanted_[column].name, parted(names_[*place]).unit, columns_[column]);
}

void ForeignTable::find_columns() {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const ForeignColumn& column = columns_[i];
    place_[i] = place_of(column.name);
    if (!column.rest.empty()) {
      rest_place_ = place_of(column.rest);
      if (!rest_place_) errors_.add(line_, missing(i, column.rest));
    }
    if (!place_[i] && (column.given || wanted_[i].required)) errors_.add(line_, missing(i, column.name));
    take_unit_of_header(i);
  }
}

std::string ForeignTable::columns_there() const {
  if (names_.empty()) return "there are " + std::to_string(fields_.size()) + " without names";
  std::string list;
  for (std::size_t i = 0; i < std::min(names_.size(), kMostNames); ++i)
    list += (i > 0 ? ", " : "") + printable(names_[i]);
  return "there are " + list + (names_.size() > kMostNames ? ", ..." : "");
}

std::string ForeignTable::missing(std::size_t column, std::string_view name) const {
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

bool ForeignTable::is_asked_for(std::size_t place) const {
  return rest_place_ == place || std::ranges::find(place_, std::optional(place)) != place_.end();
}

std::string ForeignTable::name_of(std::size_t place) const {
  return place < names_.size() ? printable(parted(names_[place]).name) : std::to_string(place + 1);
}

void ForeignTable::fail_field(std::size_t column, const std::string& why) {
  const std::string& name = columns_[column].name;
  const std::string_view text = field(column);
  const std::string what = parse_integer(name) ? "column " + name : printable(name);
  fail(what + ' ' + (text.empty() ? "is empty" : in_quotes(text) + ' ' + why));
}

/// A stamp in two columns: whole seconds and fractions, or a date and a time of day.
std::optional<Stamp> ForeignTable::stamp_of_two(std::size_t column) {
  const std::string_view whole = field(column), rest = fields_[*rest_place_];
  if (const auto date = parse_date(std::string(whole).append(1, 'T').append(rest))) return date;
  const std::optional<Stamp> seconds = parse_time(whole, 0);
  const std::optional<Stamp> beyond = parse_time(rest, columns_[column].rest_digits);
  constexpr Duration kSecond{1'000'000};
  if (seconds && beyond && *beyond >= Stamp{} && *beyond - Stamp{} <= kSecond && parse_integer(without_plus(whole)) &&
      is_plausible_stamp(to_us(*seconds + (*beyond - Stamp{}))))
    return *seconds + (*beyond - Stamp{});
  fail("columns " + printable(columns_[column].name) + " and " + printable(columns_[column].rest) + ": " +
       in_quotes(whole) + " and " + in_quotes(rest) + " are not whole seconds and what is beyond them");
  return std::nullopt;
}

std::optional<Stamp> ForeignTable::stamp(std::size_t column) {
  if (rest_place_ && !columns_[column].rest.empty()) return stamp_of_two(column);
  if (const auto date = parse_date(field(column))) return date;
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

}  // namespace azimuth
