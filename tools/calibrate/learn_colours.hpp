#pragma once
// Colour classes from labelled pixels.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "slam/perception/colour/colour_settings.hpp"
#include "slam/perception/colour/hsv.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// Pixels from the first corner to the last, both included.
struct PixelRectangle {
  int first_u = 0, first_v = 0, last_u = 0, last_v = 0;
};

/// "U0,V0,U1,V1", two opposite corners in any order, or "U,V", a point with its surroundings. Nothing when it is
/// neither or reaches out of the image.
std::optional<PixelRectangle> parse_rectangle(std::string_view text, const FrameFormat& format);
std::optional<PixelRectangle> parse_click(std::string_view text, const FrameFormat& format);

/// What somebody says has one colour.
struct LabelledPixels {
  std::string name;
  std::vector<Rgb> pixels;
};

/// Adds the pixels of a rectangle of an rgb8 image.
void add_pixels(const ImageView& image, const PixelRectangle& rectangle, std::vector<Rgb>& pixels);

/// The class that holds all but the odd ones of some pixels, and what they may look like from other places: hues a
/// little off, more grey, half the light or any more. Nothing when there are too few pixels with a hue.
std::optional<ColourClass> learn_class(const LabelledPixels& labelled);

/// `classes` with those learnt in the place of those of the same name, or after them.
std::vector<ColourClass> updated(std::vector<ColourClass> classes, std::span<const ColourClass> learnt);

/// Of each labelled colour: how many of its pixels get its own class, another class, none. A line each.
std::string separation_text(std::span<const LabelledPixels> labelled, const std::vector<ColourClass>& classes);

}  // namespace azimuth
