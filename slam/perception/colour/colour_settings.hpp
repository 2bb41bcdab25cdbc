#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace azimuth {

/// Which pixels have one of the colours that landmarks are painted in: all bounds included, hue the long way round when
/// it runs from a larger angle to a smaller one (red: from 345 to 15).
struct ColourClass {
  std::string name;
  double hue_from_deg = 0.0;
  double hue_to_deg = 360.0;
  double saturation_min = 0.55;
  double saturation_max = 1.0;
  double value_min = 0.15;  ///< darker than this, hue is noise
  double value_max = 1.0;

  friend bool operator==(const ColourClass&, const ColourClass&) = default;
};

inline constexpr std::size_t kMostColourClasses = 32;

/// What coloured landmarks look like (SPEC I.11). A landmark is upright: its two sides lie on lines through the image's
/// centre.
struct ColourSettings {
  /// In this order they are the kinds 0, 1, ... of bearings. A pixel belongs to the first that it fits. At most
  /// kMostColourClasses count.
  std::vector<ColourClass> classes{{.name = "red", .hue_from_deg = 342.0, .hue_to_deg = 18.0},
                                   {.name = "yellow", .hue_from_deg = 40.0, .hue_to_deg = 70.0},
                                   {.name = "green", .hue_from_deg = 95.0, .hue_to_deg = 155.0},
                                   {.name = "blue", .hue_from_deg = 210.0, .hue_to_deg = 250.0}};

  double area_min_px2 = 80.0;
  double area_max_px2 = 60000.0;
  double compactness_min = 0.25;  ///< of 4 pi area / perimeter^2: 1 for a disc, 0.79 for a square
  double compactness_max = 0.7;
  double elongation_min = 2.5;  ///< length along the radius over width across
  double elongation_max = 7.0;
  double fill_min = 0.85;  ///< area over length times width halfway: 1 for what lies between two straight sides
  double fill_max = 1.15;
  /// A side's point is free when neither hidden image nor something of a colour class is within so much beyond it: then
  /// it is the landmark's own edge, not that of something in front of it.
  double free_within_px = 3.0;
  double free_part_min = 0.2;     ///< of either side; what stands in front reaches beyond what stands behind
  double straightness_min = 0.6;  ///< part of either side's free points that must lie on one line
  double centre_within_px = 6.0;  ///< which must not miss the rig's image centre by more than this
  // The next two are doubled for Bayer formats, whose samples of one colour are two pixels apart.
  double straight_within_px = 1.0;  ///< a point farther from that line than this does not
  /// Standard deviation of what displaces a whole side: shade, blur, what is behind it, chroma of less resolution.
  double sigma_side_px = 0.18;
  /// YUV formats use all 256 steps (JPEG); false: 16 to 235 and 240 (television).
  bool full_range_yuv = true;

  friend bool operator==(const ColourSettings&, const ColourSettings&) = default;
};

}  // namespace azimuth
