#include "settings/colour_section.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <span>

#include "settings/section.hpp"

namespace azimuth {
namespace {

std::vector<Key> class_keys(ColourClass& colours) {
  return {
      {"name", &colours.name, "Name of the class, for people only. Only the order of the classes matters."},
      {"hue_from_deg", &colours.hue_from_deg, "First hue of the class: red 0, yellow 60, green 120, blue 240.",
       from_to(0, 360)},
      {"hue_to_deg", &colours.hue_to_deg,
       "Last hue of the class; hues from a larger to a smaller angle pass through red.", from_to(0, 360)},
      {"saturation_min", &colours.saturation_min, "Least saturation of the class: 0 for grey, 1 for a pure colour.",
       from_to(0, 1)},
      {"saturation_max", &colours.saturation_max, "Largest saturation of the class.", from_to(0, 1)},
      {"value_min", &colours.value_min,
       "Least value of the class: the brightness of the brightest of red, green and blue.", from_to(0, 1)},
      {"value_max", &colours.value_max, "Largest value (brightness) of the class.", from_to(0, 1)},
  };
}

/// Returns what is wrong with the last of the classes, if anything.
std::optional<std::string> class_problem(std::span<const ColourClass> classes) {
  const ColourClass& last = classes.back();
  if (last.name.empty()) return "needs the key 'name'";
  if (std::ranges::count(classes, last.name, &ColourClass::name) > 1)
    return fmt::format("\"{}\" is there twice", last.name);
  if (classes.size() > kMostColourClasses) return fmt::format("is one too many: there may be {}", kMostColourClasses);
  if (last.saturation_min > last.saturation_max || last.value_min > last.value_max)
    return fmt::format("\"{}\" holds no colour: a least value is above the largest", last.name);
  return std::nullopt;
}

Section class_section(std::vector<ColourClass>& classes) {
  return list_section<ColourClass>(
      "colour.class",
      "The colours of landmarks: the classes are kinds 0, 1, ... of bearings, in this order. A pixel belongs to the "
      "first class that it fits. Classes in a file replace all of these.",
      classes, class_keys, class_problem);
}

}  // namespace

Section colour_section(ColourSettings& colour) { return class_section(colour.classes); }

std::string colour_classes_text(std::vector<ColourClass> classes) { return toml_text(class_section(classes)); }

}  // namespace azimuth
