#include "settings/toml_writing.hpp"

namespace azimuth {
namespace {

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

}  // namespace azimuth
