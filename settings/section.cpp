#include "settings/section.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <type_traits>

#include "settings/suggestion.hpp"

namespace azimuth {
namespace {

std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string point_text(const PixelPoint& point) { return fmt::format("[{}, {}]", point[0], point[1]); }

std::string polygon_text(const std::vector<PixelPoint>& corners) {
  std::vector<std::string> points;
  for (const PixelPoint& corner : corners) points.push_back(point_text(corner));
  return fmt::format("[{}]", fmt::join(points, ", "));
}

struct ValueText {
  std::string operator()(const bool* member) const { return *member ? "true" : "false"; }
  std::string operator()(const int* member) const { return fmt::format("{}", *member); }
  std::string operator()(const double* member) const { return fmt::format("{}", *member); }
  std::string operator()(const std::string* member) const { return in_quotes(*member); }
  std::string operator()(const PathText& path) const { return in_quotes(*path.text); }
  std::string operator()(const PixelPoint* member) const { return point_text(*member); }
  std::string operator()(const std::optional<PixelPoint>* member) const { return *member ? point_text(**member) : ""; }
  std::string operator()(const PixelPolygons* member) const {
    std::vector<std::string> polygons;
    for (const std::vector<PixelPoint>& corners : *member) polygons.push_back(polygon_text(corners));
    return fmt::format("[{}]", fmt::join(polygons, ", "));
  }
  template <class T>
  std::string operator()(const std::optional<T>* member) const {
    return *member ? fmt::format("{}", **member) : "";
  }
  std::string operator()(const Choice& choice) const { return in_quotes(choice.words[choice.get()]); }
};

struct InRange {
  const Range& range;

  bool operator()(const int* member) const { return range.contains(*member); }
  bool operator()(const double* member) const { return range.contains(*member); }
  bool operator()(const PixelPoint* member) const {
    return range.contains((*member)[0]) && range.contains((*member)[1]);
  }
  bool operator()(const PixelPolygons* member) const {
    return std::all_of(member->begin(), member->end(), [&](const std::vector<PixelPoint>& corners) {
      return std::all_of(corners.begin(), corners.end(), [&](const PixelPoint& corner) { return (*this)(&corner); });
    });
  }
  template <class T>
  bool operator()(const std::optional<T>* member) const {
    return !*member || (*this)(&**member);
  }
  bool operator()(const bool*) const { return true; }
  bool operator()(const std::string*) const { return true; }
  bool operator()(const PathText&) const { return true; }
  bool operator()(const Choice&) const { return true; }
};

struct CopyTarget {
  void operator()(const Choice& from, const Choice& to) const { to.set(from.get()); }
  void operator()(const PathText& from, const PathText& to) const { *to.text = *from.text; }
  template <class From, class To>
  void operator()(const From& from, const To& to) const {
    if constexpr (std::is_pointer_v<From> && std::is_same_v<From, To>) {
      *to = *from;
    } else {
      assert(false && "both sections come from one table");
    }
  }
};

/// The allowed values of the key, such as "[0, 1]" or "(delayed | undelayed)"; empty if every value is.
std::string allowed(const Key& key) {
  if (const Choice* const choice = std::get_if<Choice>(&key.target))
    return fmt::format("({})", fmt::join(choice->words, " | "));
  return key.range.text();
}

std::string key_text(const Key& key) {
  const std::string range = allowed(key), value = key.value_text();
  const std::string comment = range.empty() ? std::string(key.help) : fmt::format("{} {}", key.help, range);
  if (value.empty()) return fmt::format("# {}\n# {}: no default\n", comment, key.name);
  return fmt::format("# {}\n#{} = {}\n", comment, key.name, value);
}

/// Prints all elements of a list, with helps and ranges at the first element only.
std::string commented_list(const Section& list) {
  std::string text = fmt::format("# {}\n", list.help);
  for (std::size_t i = 0; i < list.elements->count(); ++i) {
    text += fmt::format("\n#[[{}]]\n", list.name);
    for (const Key& key : list.elements->keys(i))
      text += i == 0 ? key_text(key) : fmt::format("#{} = {}\n", key.name, key.value_text());
  }
  return text;
}

std::string line(const Key& key) {
  const std::string value = key.value_text();
  return value.empty() ? "" : std::string(key.name).append(" = ").append(value).append("\n");
}

std::string list_text(const Section& list) {
  std::string text;
  for (std::size_t i = 0; i < list.elements->count(); ++i) {
    text.append("\n[[").append(list.name).append("]]\n");
    for (const Key& key : list.elements->keys(i)) text += line(key);
  }
  return text;
}

}  // namespace

std::string Range::text() const {
  const bool bottomless = std::isinf(low), endless = std::isinf(high);
  if (bottomless && endless) return "";
  if (endless) return fmt::format("{} {}", above_low ? ">" : ">=", low);
  if (bottomless) return fmt::format("<= {}", high);
  return fmt::format("{}{}, {}]", above_low ? '(' : '[', low, high);
}

std::string Key::value_text() const { return std::visit(ValueText{}, target); }

bool Key::in_range() const { return std::visit(InRange{range}, target); }

std::string_view Key::unit() const { return unit_of(name); }

Key* Section::find(std::string_view key) {
  const auto found = std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return k.name == key; });
  return found == keys.end() ? nullptr : &*found;
}

std::vector<Key> joined(std::initializer_list<std::vector<Key>> groups) {
  std::vector<Key> keys;
  for (const std::vector<Key>& group : groups) keys.insert(keys.end(), group.begin(), group.end());
  return keys;
}

Section element(const Section& list, std::size_t index) { return {list.name, list.help, list.elements->keys(index)}; }

std::vector<Section*> pointers(std::vector<Section>& sections) {
  std::vector<Section*> addresses;
  addresses.reserve(sections.size());
  for (Section& section : sections) addresses.push_back(&section);
  return addresses;
}

void copy_given(const Section& from, Section& to) {
  assert(from.keys.size() == to.keys.size());
  for (std::size_t i = 0; i < from.keys.size(); ++i) {
    if (!from.keys[i].given) continue;
    std::visit(CopyTarget{}, from.keys[i].target, to.keys[i].target);
    to.keys[i].given = true;
  }
}

std::string toml_text(const Section& section) {
  if (section.elements) return list_text(section);
  std::string text;
  if (!section.name.empty()) text.append("\n[").append(section.name).append("]\n");
  for (const Key& key : section.keys)
    if (key.given) text += line(key);
  return text;
}

std::string reference(std::span<Section* const> sections) {
  std::string text;
  for (const Section* const section : sections) {
    if (!text.empty()) text += '\n';
    if (section->elements) {
      text += commented_list(*section);
      continue;
    }
    text += section->name.empty() ? fmt::format("# {}\n", section->help)
                                  : fmt::format("[{}]\n# {}\n", section->name, section->help);
    for (const Key& key : section->keys) text += '\n' + key_text(key);
  }
  return text;
}

}  // namespace azimuth
