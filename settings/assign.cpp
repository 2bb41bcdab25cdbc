#include "settings/assign.hpp"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <utility>

namespace azimuth {
namespace {

using Trouble = std::optional<std::string>;

std::string wrong_type(std::string_view wanted, const toml::node& value) {
  return fmt::format("must be {}, not {}", wanted, kind_of(value));
}

Trouble check_range(const Range& range, double value) {
  if (!std::isfinite(value)) return fmt::format("must be finite, is {}", value);
  if (range.contains(value)) return std::nullopt;
  const std::string allowed = range.text();
  return fmt::format("is {}, must {} {}", value, allowed.front() == '[' || allowed.front() == '(' ? "lie in" : "be",
                     allowed);
}

/// Writes a checked TOML value through each kind of target.
struct Assign {
  const toml::node& value;
  const Range& range;

  Trouble operator()(bool* member) const {
    const auto flag = value.value_exact<bool>();
    if (!flag) return wrong_type("true or false", value);
    *member = *flag;
    return std::nullopt;
  }

  Trouble operator()(int* member) const {
    const auto number = value.value_exact<std::int64_t>();
    if (!number) return wrong_type("a whole number", value);
    if (Trouble trouble = check_range(range, static_cast<double>(*number))) return trouble;
    if (*number < std::numeric_limits<int>::min() || *number > std::numeric_limits<int>::max()) {
      return fmt::format("is {}, which is too large", *number);
    }
    *member = static_cast<int>(*number);
    return std::nullopt;
  }

  Trouble operator()(double* member) const {
    if (!value.is_number()) return wrong_type("a number", value);
    const toml::value<std::int64_t>* const whole = value.as_integer();
    const double number = whole ? static_cast<double>(whole->get()) : value.as_floating_point()->get();
    if (Trouble trouble = check_range(range, number)) return trouble;
    *member = number;
    return std::nullopt;
  }

  Trouble operator()(std::string* member) const {
    const auto text = value.value_exact<std::string>();
    if (!text) return wrong_type("a text in quotes", value);
    *member = *text;
    return std::nullopt;
  }

  Trouble operator()(const PathText& path) const { return (*this)(path.text); }

  template <class T>
  Trouble operator()(std::optional<T>* member) const {
    T read{};
    if (Trouble trouble = (*this)(&read)) return trouble;
    *member = read;
    return std::nullopt;
  }

  Trouble operator()(PixelPoint* member) const {
    const toml::array* const array = value.as_array();
    if (!array || array->size() != 2) return wrong_type("a pair of numbers [a, b]", value);
    PixelPoint read{};
    for (std::size_t i = 0; i < 2; ++i) {
      if (Trouble trouble = Assign{*array->get(i), range}(&read[i])) return trouble;
    }
    *member = read;
    return std::nullopt;
  }

  /// The message names the polygon and its corner, since one key can hold many of them.
  Trouble operator()(PixelPolygons* member) const {
    constexpr std::string_view kWanted = "a list of polygons [[u, v], [u, v], [u, v], ...]";
    const toml::array* const array = value.as_array();
    if (!array) return wrong_type(kWanted, value);
    PixelPolygons read(array->size());
    for (std::size_t i = 0; i < read.size(); ++i) {
      const Trouble trouble = Assign{*array->get(i), range}(&read[i]);
      if (trouble) return fmt::format("must be {}: polygon {} {}", kWanted, i + 1, *trouble);
    }
    *member = std::move(read);
    return std::nullopt;
  }

  Trouble operator()(std::vector<PixelPoint>* corners) const {
    const toml::array* const array = value.as_array();
    if (!array) return wrong_type("a list of corners", value);
    if (array->size() < 3) return fmt::format("has {} corners, needs at least 3", array->size());
    corners->resize(array->size());
    for (std::size_t i = 0; i < corners->size(); ++i) {
      const Trouble trouble = Assign{*array->get(i), range}(&(*corners)[i]);
      if (trouble) return fmt::format("corner {} {}", i + 1, *trouble);
    }
    return std::nullopt;
  }

  Trouble operator()(const Choice& choice) const {
    const auto word = value.value_exact<std::string>();
    if (!word) return wrong_type(fmt::format("one of \"{}\"", fmt::join(choice.words, "\", \"")), value);
    for (std::size_t i = 0; i < choice.words.size(); ++i) {
      if (choice.words[i] != *word) continue;
      choice.set(i);
      return std::nullopt;
    }
    return fmt::format("is \"{}\", must be one of \"{}\"", *word, fmt::join(choice.words, "\", \""));
  }
};

}  // namespace

std::optional<std::string> assign(Key& key, const toml::node& value) {
  key.given = true;
  return std::visit(Assign{value, key.range}, key.target);
}

std::string_view kind_of(const toml::node& value) {
  switch (value.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a number with a fraction";
    case toml::node_type::boolean:
      return "true or false";
    case toml::node_type::date:
      return "a date";
    case toml::node_type::time:
      return "a time";
    case toml::node_type::date_time:
      return "a date and time";
    case toml::node_type::none:
      break;
  }
  return "nothing";
}

}  // namespace azimuth
