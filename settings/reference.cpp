#include "settings/reference.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace azimuth {
namespace {

/// What the member may be, beyond its type: "[0, 1]" or "delayed | undelayed".
std::string allowed(const Key& key) {
  if (const Choice* const choice = std::get_if<Choice>(&key.target))
    return fmt::format("({})", fmt::join(choice->words, " | "));
  return key.range.text();
}

/// One that is for experts says so where it is `marked`.
std::string key_text(const Key& key, bool marked) {
  const std::string range = allowed(key), value = key.value_text();
  std::string comment = range.empty() ? std::string(key.help) : fmt::format("{} {}", key.help, range);
  if (marked && key.tier == Tier::expert) comment = "(expert) " + comment;
  if (value.empty()) return fmt::format("# {}\n# {}: no default\n", comment, key.name);
  return fmt::format("# {}\n#{} = {}\n", comment, key.name, value);
}

/// Helps and ranges stand with the first element only.
std::string commented_list(const Section& list) {
  std::string text = fmt::format("# {}\n", list.help);
  for (std::size_t i = 0; i < list.elements->count(); ++i) {
    text += fmt::format("\n#[[{}]]\n", list.name);
    for (const Key& key : list.elements->keys(i))
      text += i == 0 ? key_text(key, false) : fmt::format("#{} = {}\n", key.name, key.value_text());
  }
  return text;
}

}  // namespace

std::string reference(std::span<Section* const> sections, Tier down_to) {
  const bool everything = down_to == Tier::expert;
  const auto is_shown = [&](const Key& key) { return everything || key.tier == Tier::everyday; };
  // Where nothing is for everybody, as in a rig.toml, nothing is for experts either.
  const bool in_tiers = std::ranges::any_of(sections, [](const Section* section) {
    return std::ranges::count(section->keys, Tier::everyday, &Key::tier) > 0;
  });
  std::string text;
  for (const Section* const section : sections) {
    if (!section->elements && std::ranges::none_of(section->keys, is_shown)) continue;
    if (!text.empty()) text += '\n';
    if (section->elements) {
      text += commented_list(*section);
      continue;
    }
    text += section->name.empty() ? fmt::format("# {}\n", section->help)
                                  : fmt::format("[{}]\n# {}\n", section->name, section->help);
    for (const Key& key : section->keys)
      if (is_shown(key)) text += '\n' + key_text(key, in_tiers);
  }
  return text;
}

}  // namespace azimuth
