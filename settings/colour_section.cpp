#include "settings/colour_section.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <span>

#include "settings/toml_writing.hpp"

namespace azimuth {
namespace {

std::vector<Key> shape_keys(ColourSettings& colour) {
  return {
      {"area_min_px2", &colour.area_min_px2, "Smaller patches of colour are no landmarks.", from_to(0, 1e9)},
      {"area_max_px2", &colour.area_max_px2, "Larger ones neither.", from_to(0, 1e9)},
      {"compactness_min", &colour.compactness_min,
       "Least 4 pi area / perimeter^2 of a landmark: 1 for a disc, 0.79 for a square, less for what is long.",
       from_to(0, 2)},
      {"compactness_max", &colour.compactness_max, "Largest compactness of a landmark's outline.", from_to(0, 2)},
      {"elongation_min", &colour.elongation_min, "Least length along the radius over width across.", from_to(0, 1000)},
      {"elongation_max", &colour.elongation_max, "Largest elongation of a landmark's outline.", from_to(0, 1000)},
      {"fill_min", &colour.fill_min, "Least area over length times width: 1 between two straight sides.",
       from_to(0, 10)},
      {"fill_max", &colour.fill_max, "Largest area of a landmark over that of its outline's rectangle.",
       from_to(0, 10)},
  };
}

std::vector<Key> side_keys(ColourSettings& colour) {
  return {
      {"free_within_px", &colour.free_within_px,
       "A point of a side counts when nothing hidden or coloured is within this distance beyond it.", from_to(0, 100)},
      {"free_part_min", &colour.free_part_min, "Least part of either side that counts.", from_to(0, 1)},
      {"straightness_min", &colour.straightness_min, "Least part of that which must lie on one line.", from_to(0, 1)},
      {"straight_within_px", &colour.straight_within_px,
       "A point farther from the line than this does not lie on it; twice as far for Bayer formats.", above_to(0, 100)},
      {"centre_within_px", &colour.centre_within_px,
       "The line must not miss the image's centre by more than this: the rig's centre may be off by it.",
       from_to(0, 100)},
      {"sigma_side_px", &colour.sigma_side_px,
       "Standard deviation of what displaces a whole side (shade, blur); twice as much for Bayer formats.",
       from_to(0, 100)},
      {"full_range_yuv", &colour.full_range_yuv,
       "YUV cameras use all 256 steps, as in JPEG; false: 16 to 235, as in television."},
  };
}

std::vector<Key> class_keys(ColourClass& colours) {
  return {
      {"name", &colours.name, "The class's name, of use to people only. The order of the classes is what counts."},
      {"hue_from_deg", &colours.hue_from_deg, "Hue: red 0, yellow 60, green 120, blue 240.", from_to(0, 360)},
      {"hue_to_deg", &colours.hue_to_deg, "Up to here; from a larger to a smaller angle it passes through red.",
       from_to(0, 360)},
      {"saturation_min", &colours.saturation_min, "Least saturation: 0 for grey, 1 for a pure colour.", from_to(0, 1)},
      {"saturation_max", &colours.saturation_max, "Largest saturation of the class.", from_to(0, 1)},
      {"value_min", &colours.value_min, "Least brightness of the brightest of red, green and blue.", from_to(0, 1)},
      {"value_max", &colours.value_max, "Largest value (brightness) of the class.", from_to(0, 1)},
  };
}

/// What is wrong with the last of some classes.
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
      "The colours of landmarks: kinds 0, 1, ... of bearings in this order. A pixel belongs to "
      "the first that it fits. Classes given here replace all of these.",
      classes, class_keys, class_problem);
}

}  // namespace

std::vector<Section> colour_sections(ColourSettings& colour) {
  Section shape{"colour", "Landmarks in the images of the front end \"colour\": upright, and painted.",
                joined({shape_keys(colour), side_keys(colour)})};
  return {std::move(shape), class_section(colour.classes)};
}

std::string colour_classes_text(std::vector<ColourClass> classes) { return toml_text(class_section(classes)); }

}  // namespace azimuth
