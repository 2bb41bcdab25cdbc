#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "slam/sample/stamp.hpp"

namespace azimuth {

/// The name a sensor gives to what it sees (a barcode, a colour tag). kUnknownIdentity: it cannot tell.
using Identity = std::int64_t;
inline constexpr Identity kUnknownIdentity = -1;

/// What sort of thing was seen, as far as the sensor can tell sorts but not things apart (the class of a coloured
/// landmark). Things of two kinds are never the same thing. kAnyKind: it cannot tell.
using Kind = std::int32_t;
inline constexpr Kind kAnyKind = -1;
constexpr bool same_kind(Kind a, Kind b) { return a == b || a == kAnyKind || b == kAnyKind; }

/// One direction in the robot's frame.
struct Bearing {
  double azimuth_rad = 0.0;  ///< counter-clockwise from the robot's heading, in [-pi, pi)
  double elevation_rad = std::numeric_limits<double>::quiet_NaN();  ///< up from the horizontal; NaN: not measured
  Identity identity = kUnknownIdentity;
  Kind kind = kAnyKind;
  /// Standard deviation of the azimuth; NaN: the rig's sigma_bearing_rad.
  double sigma_rad = std::numeric_limits<double>::quiet_NaN();
  /// Distance from the image's centre, whose error turns near bearings more than far ones; NaN: not from an image.
  double radius_px = std::numeric_limits<double>::quiet_NaN();
  /// Standard deviation of the elevation; NaN: not known.
  double sigma_elevation_rad = std::numeric_limits<double>::quiet_NaN();
};

/// What the surroundings of a feature look like (SPEC I.12): 4 x 4 regions of 8 directions, 8 bits each.
struct alignas(32) Descriptor {
  std::array<std::uint8_t, 128> values{};
  friend bool operator==(const Descriptor&, const Descriptor&) = default;
};

/// The features nearest to a feature in its image, by index into the same set, nearest first (SPEC I.14).
struct Neighbours {
  static constexpr std::size_t kMost = 5;
  static constexpr std::uint16_t kNone = 0xffff;
  std::array<std::uint16_t, kMost> index{kNone, kNone, kNone, kNone, kNone};
  friend bool operator==(const Neighbours&, const Neighbours&) = default;
};

/// What speaks against using an image. Travels with the (empty) set that was seen in it, so that the estimate's health
/// can name it. The numbers stand in logs: never change one.
enum class ImageTrouble : std::uint8_t {
  none = 0,
  unreadable = 1,   ///< wrong size or format, or cut short
  dark = 2,         ///< hardly anything is brighter than black
  overexposed = 3,  ///< most of it is white
  featureless = 4,  ///< one grey: covered or out of focus
  frozen = 5,       ///< the same image again and again
  torn = 6,         ///< rows of two instants, or filled up for want of more
};

inline constexpr int kImageTroubles = 7;

/// The enumerator's meaning in a few words; empty for none.
constexpr std::string_view to_string(ImageTrouble trouble) {
  switch (trouble) {
    case ImageTrouble::none:
      return "";
    case ImageTrouble::unreadable:
      return "the camera's images cannot be read";
    case ImageTrouble::dark:
      return "the camera's images are dark";
    case ImageTrouble::overexposed:
      return "the camera's images are overexposed";
    case ImageTrouble::featureless:
      return "the camera's images show nothing";
    case ImageTrouble::frozen:
      return "the camera's images stand still";
    case ImageTrouble::torn:
      return "the camera's images are torn";
  }
  return "?";
}

/// Room that storage for the bearings of one image starts with.
inline constexpr std::size_t kTypicalBearings = 32;

/// All bearings of one instant (one image). May be empty: an image in which nothing was found.
struct BearingSet {
  Stamp stamp{};
  std::uint64_t sequence = 0;  ///< counts sets at their source; a gap means sets were lost
  std::vector<Bearing> bearings;
  // Of features that are told apart by their looks; else empty. One entry for each bearing.
  std::vector<Descriptor> descriptors = {};
  std::vector<Neighbours> neighbours = {};
  ImageTrouble trouble = ImageTrouble::none;

  /// Nothing seen, storage kept; stamp and sequence stay.
  void clear() {
    bearings.clear();
    descriptors.clear();
    neighbours.clear();
    trouble = ImageTrouble::none;
  }
};

}  // namespace azimuth
