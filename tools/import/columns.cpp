#include "tools/import/columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "drivers/wire/number_text.hpp"
#include "settings/suggestion.hpp"
#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

struct Unit {
  std::string_view name, of;  // of: ending of the value's name
  double factor;
};
constexpr std::array<Unit, 12> kUnits{{{"m", "m", 1.0},
                                       {"cm", "m", 1e-2},
                                       {"mm", "m", 1e-3},
                                       {"km", "m", 1e3},
                                       {"rad", "rad", 1.0},
                                       {"deg", "rad", kPi / 180.0},
                                       {"m/s", "m_s", 1.0},
                                       {"cm/s", "m_s", 1e-2},
                                       {"mm/s", "m_s", 1e-3},
                                       {"km/h", "m_s", 1.0 / 3.6},
                                       {"rad/s", "rad_s", 1.0},
                                       {"deg/s", "rad_s", kPi / 180.0}}};
constexpr std::array<std::string_view, 4> kTimes{"s", "ms", "us",
                                                 "ns"};  // each unit adds three digits to the previous one

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

/// The units that fit `value`, as text.
std::string units_of(std::string_view value) {
  if (value == "t_s") return "s, ms, us, ns";
  std::string words;
  for (const Unit& unit : kUnits)
    if (unit.of == unit_of(value)) words += std::string(unit.name) + ", ";
  return words + "or a number to multiply by";
}

/// Sets a unit by name or as a number; false if it is neither.
bool set_unit(std::string_view value, std::string_view unit, ForeignColumn& column) {
  if (take_unit(value, unit, column)) return true;
  if (value == "t_s") return false;
  column.unit = unit;
  const std::optional<double> factor = parse_double(unit);
  if (!factor || !std::isfinite(*factor) || *factor == 0.0) return false;
  column.factor *= *factor;
  return true;
}

/// Parses SECONDS+NANOSECONDS. The unit applies to the second column.
std::string read_two_columns(std::string_view first, std::string_view second, ForeignColumn& column) {
  column.name = without_blanks(first);
  column.rest = without_blanks(second);
  column.rest_digits = column.unit.empty() ? 9 : std::exchange(column.digits, 0);
  const bool whole = column.name.empty() || column.rest.empty() || column.rest_digits == 0;
  return whole ? "must have the form t_s=SECONDS+NANOSECONDS; [ms] or [us] behind it says that the second is in those"
               : "";
}

/// Parses [-]COLUMN[UNIT]. Returns the error, or an empty text.
std::string read_column(std::string_view value, std::string_view text, ForeignColumn& column) {
  column = {.name = {}, .given = true};
  if (text.starts_with('-')) {
    if (value == "t_s") return "time runs forwards";
    column.factor = -1.0;
    text.remove_prefix(1);
  }
  if (const std::size_t bracket = text.rfind('['); text.ends_with(']') && bracket != std::string_view::npos) {
    const std::string_view unit = without_blanks(text.substr(bracket + 1, text.size() - bracket - 2));
    text = without_blanks(text.substr(0, bracket));
    if (!set_unit(value, unit, column)) return "unit \"" + std::string(unit) + "\" must be one of " + units_of(value);
  }
  if (const std::size_t plus = text.find('+'); value == "t_s" && plus != std::string_view::npos)
    return read_two_columns(text.substr(0, plus), text.substr(plus + 1), column);
  column.name = text;
  return text.empty() ? "must have the form VALUE=COLUMN[UNIT]" : "";
}

/// The names of `wanted`, separated by commas.
std::string names_of(std::span<const WantedColumn> wanted) {
  std::string names;
  for (const WantedColumn& each : wanted) names += (names.empty() ? "" : ", ") + std::string(each.name);
  return names;
}

std::string unknown_value(std::string_view value, std::span<const WantedColumn> wanted) {
  std::vector<std::string_view> names;
  for (const WantedColumn& each : wanted) names.push_back(each.name);
  auto meant = same_but_unit(value, names);
  if (!meant) meant = nearest(value, names);
  const std::string said = "\"" + std::string(value) + "\" is not one of " + names_of(wanted);
  return meant ? said + "; did you mean " + std::string(*meant) + '?' : said;
}

}  // namespace

bool take_unit(std::string_view value, std::string_view unit, ForeignColumn& column) {
  if (value == "t_s") {
    const std::optional<int> digits = digits_of_time(unit);
    if (!digits) return false;
    column.unit = unit;
    column.digits = *digits;
    return true;
  }
  const auto known =
      std::ranges::find_if(kUnits, [&](const Unit& each) { return each.name == unit && each.of == unit_of(value); });
  if (known == kUnits.end()) return false;
  column.unit = unit;
  column.factor *= known->factor;
  return true;
}

std::optional<int> digits_of_time(std::string_view unit) {
  const auto time = std::ranges::find(kTimes, unit);
  if (time == kTimes.end()) return std::nullopt;
  return 3 * static_cast<int>(time - kTimes.begin());
}

FileResult<std::vector<ForeignColumn>> parse_columns(std::string_view text, std::span<const WantedColumn> wanted,
                                                     const std::string& option) {
  std::vector<ForeignColumn> columns;
  for (const WantedColumn& each : wanted) columns.push_back({.name = std::string(each.name)});
  FileErrors errors;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(','), text.size());
    const std::string_view entry = without_blanks(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::string_view value = without_blanks(entry.substr(0, entry.find('=')));
    const auto known = std::ranges::find(wanted, value, &WantedColumn::name);
    std::string problem;
    if (value.size() == entry.size()) {
      problem = "must have the form VALUE=COLUMN[UNIT]";
    } else if (known == wanted.end()) {
      problem = unknown_value(value, wanted);
    } else if (ForeignColumn& column = columns[static_cast<std::size_t>(known - wanted.begin())]; column.given) {
      problem = "names " + std::string(value) + " twice";
    } else {
      problem = read_column(value, without_blanks(entry.substr(value.size() + 1)), column);
    }
    if (!problem.empty()) errors.push_back({option + ' ' + std::string(entry), 0, std::move(problem)});
  }
  if (!errors.empty()) return failure(std::move(errors));
  return columns;
}

}  // namespace azimuth
