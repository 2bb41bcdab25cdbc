#include "settings/toml_writing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace azimuth {
namespace {

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
