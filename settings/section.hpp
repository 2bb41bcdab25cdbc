#pragma once
// The one table behind every settings struct: reading, ranges, overrides, the printed reference and the shipped
// configuration all come from it, so a key is written down once.

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

/// Values a number may have, both ends included unless `above_low`.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool above_low = false;  ///< `low` itself is refused

  bool contains(double value) const { return (above_low ? value > low : value >= low) && value <= high; }
  std::string text() const;  ///< "[0, 1]", "(0, 1]", ">= 0"; empty when everything is allowed
};

inline Range from_to(double low, double high) { return {low, high, false}; }
inline Range above_to(double low, double high) { return {low, high, true}; }

/// A member that takes one of a few words.
struct Choice {
  std::vector<std::string_view> words;
  std::function<std::size_t()> get;  ///< index of the present word
  std::function<void(std::size_t)> set;
};

/// A text that is a path, or has one in it: a relative one that a file gives begins at that file's folder, see
/// place_paths(); one of the command line at the working directory.
struct PathText {
  std::string* text;
  std::string_view (*path_in)(std::string_view text);  ///< the path, as a part of the text; empty: it has none
};

/// The member a key writes to. An optional one has no default: absent means the file does not say.
using Target = std::variant<bool*, int*, double*, std::string*, std::optional<int>*, std::optional<double>*,
                            PixelPoint*, std::optional<PixelPoint>*, PixelPolygons*, Choice, PathText>;

/// Whom a setting is for.
enum class Tier {
  everyday,  ///< the owner of a robot may want to change it
  expert     ///< right as it is, unless one knows what it does inside
};

/// One setting. Name, unit and help are static text; a name ends in its unit when it has one.
struct Key {
  std::string_view name;
  Target target;
  std::string_view help;
  Range range = {};
  bool given = false;  ///< by a file or an override, rightly or wrongly
  Tier tier = Tier::expert;

  /// The member's present value in TOML's notation; empty when absent.
  std::string value_text() const;
  /// Whether the member's present value is allowed (an absent one is).
  bool in_range() const;
  std::string_view unit() const;  ///< by the name's suffix; empty: a pure number, text or flag
};

/// The key, for everybody.
inline Key everyday(Key key) {
  key.tier = Tier::everyday;
  return key;
}

/// A list behind a table that may stand several times, [[name]], once for each element.
struct Elements {
  std::function<std::size_t()> count;
  std::function<void(std::size_t)> resize;                  ///< new elements have all defaults
  std::function<std::vector<Key>(std::size_t index)> keys;  ///< bound to one element, until the next resize
  std::function<std::optional<std::string>(std::size_t index)> problem;  ///< what is wrong with one as a whole
};

/// The keys of one TOML table, bound to the struct they fill.
struct Section {
  std::string_view name;  ///< dotted, e.g. "daemon.lcm"; empty: the top of the file
  std::string_view help;
  std::vector<Key> keys;               ///< none when there are elements
  std::optional<Elements> elements{};  ///< a file that has any replaces all that are there

  Key* find(std::string_view key);
};

/// A key for an enum (or anything comparable) with its words.
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

/// A key whose text is a path as a whole, or empty.
inline Key path_key(std::string_view name, std::string& member, std::string_view help) {
  return {name, PathText{&member, [](std::string_view text) { return text; }}, help};
}

/// A table of lists. `keys_of` names the keys of one element, `problem` sees the elements up to and including the one
/// in question.
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

/// The keys of an element, as a table of its own.
Section element(const Section& list, std::size_t index);

/// The addresses of `sections`, the form in which tables of several owners are passed together.
std::vector<Section*> pointers(std::vector<Section>& sections);

/// Copies the value of every key that was `given` in `from` to the same key of `to`; both come from one table.
void copy_given(const Section& from, Section& to);

}  // namespace azimuth
