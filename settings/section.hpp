#pragma once
// The table of keys behind every settings struct. Reading, ranges, overrides, the printed reference and the shipped
// configuration all use the table, so each key is defined once.

#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "slam/estimator/rig.hpp"

namespace azimuth {

/// The allowed values of a number, with both ends included unless `above_low`.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool above_low = false;  ///< true: `low` itself is refused

  bool contains(double value) const { return (above_low ? value > low : value >= low) && value <= high; }
  std::string text() const;  ///< "[0, 1]", "(0, 1]", ">= 0"; empty if every value is allowed
};

inline Range from_to(double low, double high) { return {low, high, false}; }
inline Range above_to(double low, double high) { return {low, high, true}; }

/// A member that takes one of a few words.
struct Choice {
  std::vector<std::string_view> words;
  std::function<std::size_t()> get;  ///< index of the present word
  std::function<void(std::size_t)> set;
};

/// A text that is a path or contains one. A relative path in a file begins at the folder of the file, see
/// place_paths(); a relative path on the command line begins at the working directory.
struct PathText {
  std::string* text;
  std::string_view (*path_in)(std::string_view text);  ///< returns the path within the text; empty: the text has none
};

/// The member that a key writes to. An optional member has no default: it is absent if the file does not give the key.
using Target = std::variant<bool*, int*, double*, std::string*, std::optional<int>*, std::optional<double>*,
                            PixelPoint*, std::optional<PixelPoint>*, PixelPolygons*, Choice, PathText>;

/// One setting. Name and help are static text; the name ends in the unit, if the setting has one.
struct Key {
  std::string_view name;
  Target target;
  std::string_view help;
  Range range = {};
  bool given = false;  ///< a file or an override gave the key, with a valid value or not

  /// The member's present value in TOML notation; empty if the member is absent.
  std::string value_text() const;
  /// Whether the member's present value is allowed. An absent member is.
  bool in_range() const;
  std::string_view unit() const;  ///< suffix of the name; empty: a pure number, text or flag
};

/// The list behind a table [[name]] that a file may give several times, once per element.
struct Elements {
  std::function<std::size_t()> count;
  std::function<void(std::size_t)> resize;                  ///< new elements have the defaults
  std::function<std::vector<Key>(std::size_t index)> keys;  ///< bound to one element, until the next resize
  std::function<std::optional<std::string>(std::size_t index)> problem;  ///< what is wrong with an element as a whole
};

/// The keys of one TOML table, bound to the struct that they fill.
struct Section {
  std::string_view name;  ///< dotted, e.g. "daemon.lcm"; empty: the top of the file
  std::string_view help;
  std::vector<Key> keys;               ///< empty if there are elements
  std::optional<Elements> elements{};  ///< the elements in a file replace all present ones

  Key* find(std::string_view key);
};

/// Makes a key for an enum, or any comparable type, with its words.
template <class T>
Key choice(std::string_view name, T& member, std::vector<std::pair<std::string_view, T>> options,
           std::string_view help) {
  Choice target;
  for (const auto& option : options) target.words.push_back(option.first);
  target.get = [&member, options] {
    std::size_t index = 0;
    while (index + 1 < options.size() && !(options[index].second == member)) ++index;
    return index;
  };
  target.set = [&member, options](std::size_t index) { member = options[index].second; };
  return {name, std::move(target), help};
}

/// The keys of all `groups`, in their order.
std::vector<Key> joined(std::initializer_list<std::vector<Key>> groups);

/// Makes a key whose whole text is a path, or empty.
inline Key path_key(std::string_view name, std::string& member, std::string_view help) {
  return {name, PathText{&member, [](std::string_view text) { return text; }}, help};
}

/// Makes the table of a list. `keys_of` returns the keys of one element. `problem` gets the elements up to and
/// including the one to judge.
template <class T>
Section list_section(std::string_view name, std::string_view help, std::vector<T>& list,
                     std::vector<Key> (*keys_of)(T&), std::optional<std::string> (*problem)(std::span<const T>)) {
  return {name,
          help,
          {},
          Elements{[&list] { return list.size(); }, [&list](std::size_t count) { list.resize(count); },
                   [&list, keys_of](std::size_t index) { return keys_of(list[index]); },
                   [&list, problem](std::size_t index) { return problem(std::span<const T>(list).first(index + 1)); }}};
}

/// One element of a list as a table.
Section element(const Section& list, std::size_t index);

/// The addresses of `sections`, so that tables of several owners can be passed together.
std::vector<Section*> pointers(std::vector<Section>& sections);

/// Copies the value of every `given` key of `from` to the same key of `to`. Both sections come from one table.
void copy_given(const Section& from, Section& to);

/// Writes the `given` keys at their present values below the table's header, or all elements and keys of a list.
/// Reading the text gives the same values.
std::string toml_text(const Section& section);

/// Returns every key of `sections` as TOML, commented out at its present value, with its help and range. The text is
/// both the printed reference and the shipped configuration. Removing the `#` before a key gives a valid file.
std::string reference(std::span<Section* const> sections);

}  // namespace azimuth
