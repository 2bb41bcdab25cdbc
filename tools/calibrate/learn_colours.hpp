#pragma once
// Learns colour classes from labelled pixels.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "slam/perception/colour/class_table.hpp"
#include "slam/perception/colour/colour_settings.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// The pixels from the first corner to the last corner, both included.
struct PixelRectangle {
  int first_u = 0, first_v = 0, last_u = 0, last_v = 0;
};

/// Parses "U0,V0,U1,V1": two opposite corners in any order. Nothing if the text is malformed or the rectangle reaches
/// out of the image.
std::optional<PixelRectangle> parse_rectangle(std::string_view text, const FrameFormat& format);
/// Parses "U,V" and returns a small square around that point, clipped to the image. Nothing if the text is malformed or
/// the point is outside the image.
std::optional<PixelRectangle> parse_click(std::string_view text, const FrameFormat& format);

/// Pixels that the user labels with one colour name.
struct LabelledPixels {
  std::string name;
  std::vector<Rgb> pixels;
};

/// Adds the pixels of a rectangle of an rgb8 image.
void add_pixels(const ImageView& image, const PixelRectangle& rectangle, std::vector<Rgb>& pixels);

/// The class that holds all labelled pixels except outliers, with margins for other viewpoints: a slightly different
/// hue, lower saturation, and any value from half the lowest one upwards. Nothing if too few pixels have a hue.
std::optional<ColourClass> learn_class(const LabelledPixels& labelled);

/// `classes` with each learnt class replacing the one of the same name, or appended if there is none.
std::vector<ColourClass> updated(std::vector<ColourClass> classes, std::span<const ColourClass> learnt);

/// One line for each labelled colour: the shares of its pixels that get its own class, another class, and no class.
std::string separation_text(std::span<const LabelledPixels> labelled, const std::vector<ColourClass>& classes);

}  // namespace azimuth
