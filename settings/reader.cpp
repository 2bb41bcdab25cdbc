#include "settings/reader.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "settings/assign.hpp"
#include "settings/retired_keys.hpp"
#include "settings/suggestion.hpp"
#include "settings/toml_text.hpp"

namespace azimuth {
namespace {

using Sections = std::span<Section* const>;

Section* find_section(Sections sections, std::string_view name) {
  const auto found = std::find_if(sections.begin(), sections.end(), [&](const Section* s) { return s->name == name; });
  return found == sections.end() ? nullptr : *found;
}

/// Whether `path` is a section or a parent of one: "daemon" of "daemon.lcm" may be written as a table without keys.
bool is_section_or_parent(Sections sections, std::string_view path) {
  return std::any_of(sections.begin(), sections.end(), [&](const Section* section) {
    return section->name == path || (section->name.starts_with(path) && section->name.substr(path.size())[0] == '.');
  });
}

std::vector<std::string_view> key_names(const Section& section) {
  std::vector<std::string_view> names;
  for (const Key& key : section.keys) names.push_back(key.name);
  return names;
}

std::string join(std::string_view path, std::string_view name) {
  return path.empty() ? std::string(name) : fmt::format("{}.{}", path, name);
}

std::string describe(const Section& section) {
  if (section.elements) return fmt::format("in [[{}]]", section.name);
  return section.name.empty() ? "at the top of the file" : fmt::format("in [{}]", section.name);
}

bool has_key(Section& section, std::string_view key) {
  if (!section.elements || section.elements->count() == 0) return section.find(key) != nullptr;
  return element(section, 0).find(key) != nullptr;
}

/// Returns a text such as ": 2.5 deg is 0.0436332 rad", or an empty text if the value cannot be converted.
std::string conversion(std::string_view key, std::string_view known, const toml::node& value) {
  const auto number = value.is_number() ? value.value<double>() : std::nullopt;
  const auto result = number ? converted(*number, unit_of(key), unit_of(known)) : std::nullopt;
  return result ? fmt::format(": {} {} is {:.6g} {}", *number, unit_of(key), *result, unit_of(known)) : "";
}

/// A key of an earlier version with its present name.
struct Moved {
  std::string_view section, key, now;
};
constexpr std::string_view kPresetNow = "preset, at the top of the file";
constexpr Moved kMoved[] = {
    {"ekf", "preset", kPresetNow},
    {"fastslam", "preset", kPresetNow},
    {"identity", "preset", kPresetNow},
    {"sift", "preset", kPresetNow},
    {"ekf", "relocalise", "relocalisation.lost_log_odds, where 0 stands for false"},
    {"smoother", "calibrate_turn", "odometry.sigma_scale_turn of the rig, where 0 stands for false"},
};

std::string unknown_key(Sections sections, const Section& section, std::string_view key, const toml::node& value,
                        const std::string& place) {
  const std::string what = fmt::format("unknown key '{}' {}", key, place);
  for (const Moved& moved : kMoved)
    if (moved.section == section.name && moved.key == key) return fmt::format("{}; it is {} now", what, moved.now);
  if (is_retired(section.name, key)) return fmt::format("{}; {}", what, kRetiredKey);
  const auto names = key_names(section);
  if (const auto known = same_but_unit(key, names)) {
    return fmt::format("{}; the key is '{}', in {}{}", what, *known, unit_of(*known), conversion(key, *known, value));
  }
  for (Section* other : sections) {
    if (has_key(*other, key)) return fmt::format("{}; it belongs {}", what, describe(*other));
  }
  if (const auto known = nearest(key, names)) return fmt::format("{}; did you mean '{}'?", what, *known);
  return what;
}

std::string unknown_section(Sections sections, std::string_view path) {
  std::vector<std::string_view> names;
  for (const Section* section : sections) {
    if (!section->name.empty()) names.push_back(section->name);
  }
  const auto known = nearest(path, names);
  return fmt::format("unknown section [{}]{}", path, known ? fmt::format("; did you mean [{}]?", *known) : "");
}

constexpr std::size_t kMostViolations = 100;  // the walk stops here, since nobody reads more

/// Walks the tree of one file and hands every value to its key.
struct Walk {
  const std::string& file;
  Sections sections;
  std::span<const std::string_view> others;
  FileErrors& violations;
  std::vector<std::string>* warnings;

  void report(const toml::key& at, std::string message) const { report(at.source(), std::move(message)); }
  void report(const toml::source_region& at, std::string message) const {
    const toml::source_position where = at.begin;
    violations.push_back({file, static_cast<int>(where.line), std::move(message), static_cast<int>(where.column)});
  }

  bool is_enough() const { return violations.size() >= kMostViolations; }

  void table(const toml::table& table, const std::string& path) const {
    for (auto&& [key, value] : table)
      if (!is_enough()) entry(path, key, value);
  }

  /// Reads every [[table]] of a list. The tables replace the earlier elements of the list.
  void list(Section& section, const toml::key& key, const toml::node& value) const {
    if (!value.is_array_of_tables()) {
      return report(key, fmt::format("'{0}' must be tables headed [[{0}]], not {1}", section.name, kind_of(value)));
    }
    section.elements->resize(0);
    for (const toml::node& each : *value.as_array()) {
      if (is_enough()) return;
      const std::size_t index = section.elements->count();
      section.elements->resize(index + 1);
      Section one = element(section, index);
      for (auto&& [name, member] : *each.as_table())
        if (!is_enough()) member_of(one, section, name, member);
      if (const auto problem = section.elements->problem(index))
        report(each.source(), fmt::format("[[{}]] {}", section.name, *problem));
    }
  }

  void unknown(const Section& section, const Section& named, const toml::key& key, const toml::node& value) const {
    const std::string message = unknown_key(sections, section, key.str(), value, describe(named));
    if (!warnings || !is_retired(named.name, key.str())) return report(key, message);
    warnings->push_back(fmt::format("{}:{}: {}, and the value is ignored", file, key.source().begin.line, message));
  }

  void member_of(Section& one, const Section& list, const toml::key& key, const toml::node& value) const {
    Key* const known = one.find(key.str());
    if (!known) return unknown(one, list, key, value);
    if (auto trouble = assign(*known, value)) report(key, fmt::format("'{}.{}' {}", list.name, key.str(), *trouble));
  }

  void entry(const std::string& path, const toml::key& key, const toml::node& value) const {
    const std::string child = join(path, key.str());
    if (std::find(others.begin(), others.end(), child) != others.end()) return;
    Section* const section = find_section(sections, path);
    Section* const named = find_section(sections, child);
    if (named && named->elements) return list(*named, key, value);
    Key* const known = section ? section->find(key.str()) : nullptr;
    if (known) {
      if (auto trouble = assign(*known, value)) report(key, fmt::format("'{}' {}", child, *trouble));
    } else if (is_section_or_parent(sections, child)) {
      if (value.is_table()) return table(*value.as_table(), child);
      report(key, fmt::format("'{}' must be a table, not {}", child, kind_of(value)));
    } else if (!section && !value.is_table() && is_section_or_parent(sections, path)) {
      const Section parent{path, "", {}};  // a table without keys of its own, such as [colour]
      unknown(parent, parent, key, value);
    } else if (value.is_table() || !section) {
      report(key, unknown_section(sections, value.is_table() ? child : path));
    } else {
      unknown(*section, *section, key, value);
    }
  }
};

/// Reads `text` as a TOML value. A value of a text key needs no quotes.
toml::table override_value(const Key& key, const std::string& text) {
  const ParsedToml parsed = parse_toml("value = " + text, "");
  const bool wants_text = std::holds_alternative<std::string*>(key.target) ||
                          std::holds_alternative<Choice>(key.target) || std::holds_alternative<PathText>(key.target);
  const bool is_text = parsed.root.contains("value") && parsed.root.get("value")->is_string();
  if (parsed.violations.empty() && parsed.root.contains("value") && (is_text || !wants_text)) return parsed.root;
  toml::table quoted;
  quoted.insert("value", text);
  return quoted;
}

}  // namespace

FileErrors read_toml(std::string_view text, const std::string& file, std::span<Section* const> sections,
                     std::span<const std::string_view> others, std::vector<std::string>* warnings) {
  ParsedToml parsed = parse_toml(text, file);
  if (parsed.complete) Walk{file, sections, others, parsed.violations, warnings}.table(parsed.root, "");
  std::stable_sort(parsed.violations.begin(), parsed.violations.end(), [](const FileError& a, const FileError& b) {
    return std::tie(a.line, a.column) < std::tie(b.line, b.column);
  });
  if (parsed.violations.size() >= kMostViolations)
    parsed.violations.push_back({file, 0, "perhaps more: not more than these were looked for"});
  return std::move(parsed.violations);
}

FileErrors apply_override(const std::string& assignment, std::span<Section* const> sections) {
  const auto refuse = [&](std::string message) { return FileErrors{{"--set " + assignment, 0, std::move(message)}}; };
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos) return refuse("must have the form section.key=value");
  const std::string path = assignment.substr(0, equals);
  const std::size_t dot = path.rfind('.');
  const std::string section_name = dot == std::string::npos ? "" : path.substr(0, dot);
  const std::string name = dot == std::string::npos ? path : path.substr(dot + 1);

  Section* const section = find_section(sections, section_name);
  if (!section) return refuse(unknown_section(sections, section_name));
  if (section->elements) return refuse(fmt::format("[[{}]] is a list, which only a file can give", section_name));
  Key* const key = section->find(name);
  const std::string text = assignment.substr(equals + 1);
  if (!key) return refuse(unknown_key(sections, *section, name, toml::value<std::string>(text), describe(*section)));
  const toml::table value = override_value(*key, text);
  if (auto trouble = assign(*key, *value.get("value"))) return refuse(fmt::format("'{}' {}", path, *trouble));
  return {};
}

}  // namespace azimuth
