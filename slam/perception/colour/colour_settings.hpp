#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace azimuth {

/// The range of pixel colours of one landmark colour. All bounds are inclusive. If the hue range starts at a larger
/// angle than it ends, it passes through 0 (red: from 345 to 15).
struct ColourClass {
  std::string name;
  double hue_from_deg = 0.0;
  double hue_to_deg = 360.0;
  double saturation_min = 0.55;
  double saturation_max = 1.0;
  double value_min = 0.15;  ///< The hue of darker pixels is noise
  double value_max = 1.0;

  friend bool operator==(const ColourClass&, const ColourClass&) = default;
};

inline constexpr std::size_t kMostColourClasses = 32;

/// The appearance of coloured landmarks (mathematics I.11). A landmark is upright: its two sides lie on lines through
/// the centre of the image.
struct ColourSettings {
  /// The index of a class is the kind (0, 1, ...) of its bearings. A pixel belongs to the first class that it fits.
  /// Only the first kMostColourClasses classes are used.
  std::vector<ColourClass> classes{{.name = "red", .hue_from_deg = 342.0, .hue_to_deg = 18.0},
                                   {.name = "yellow", .hue_from_deg = 40.0, .hue_to_deg = 70.0},
                                   {.name = "green", .hue_from_deg = 95.0, .hue_to_deg = 155.0},
                                   {.name = "blue", .hue_from_deg = 210.0, .hue_to_deg = 250.0}};

  double area_min_px2 = 80.0;
  double area_max_px2 = 60000.0;
  double compactness_min = 0.25;  ///< Bound on 4 pi area / perimeter^2: 1 for a disc, 0.79 for a square.
  double compactness_max = 0.7;
  double elongation_min = 2.5;  ///< Length along the radius over width across it
  double elongation_max = 7.0;
  double fill_min = 0.85;  ///< Area over length times width halfway along: 1 for a shape between two straight sides.
  double fill_max = 1.15;
  /// A side's point is free if the area within this distance beyond it is neither hidden nor of a colour class. A free
  /// point lies on the landmark's own edge, not on the edge of an object in front of it.
  double free_within_px = 3.0;
  /// Least share of free points on either side; occluding objects extend beyond the occluded ones.
  double free_part_min = 0.2;
  double straightness_min = 0.6;  ///< Least share of either side's free points that must lie on one line
  double centre_within_px = 6.0;  ///< Greatest distance at which a side's line may pass the rig's image centre
  // The next two are doubled for Bayer formats, whose samples of one colour are two pixels apart.
  double straight_within_px = 1.0;  ///< Greatest distance of a point from the line it counts as lying on
  /// Standard deviation of displacements of a whole side: shading, blur, background, chroma of lower resolution.
  double sigma_side_px = 0.18;
  /// True: YUV formats use the full range 0 to 255 (JPEG). False: 16 to 235 and 16 to 240 (television).
  bool full_range_yuv = true;

  friend bool operator==(const ColourSettings&, const ColourSettings&) = default;
};

}  // namespace azimuth
