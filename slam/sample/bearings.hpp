#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "slam/geometry/angle.hpp"
#include "slam/sample/stamp.hpp"

namespace azimuth {

/// The identity that a sensor reports for a landmark (a barcode, a colour tag). kUnknownIdentity: unknown.
using Identity = std::int64_t;
inline constexpr Identity kUnknownIdentity = -1;

/// The kind of a landmark, for a sensor that distinguishes kinds but not individual landmarks (the class of a coloured
/// landmark). Two landmarks of different kinds are never the same one. kAnyKind: unknown.
using Kind = std::int32_t;
inline constexpr Kind kAnyKind = -1;
constexpr bool same_kind(Kind a, Kind b) { return a == b || a == kAnyKind || b == kAnyKind; }

/// A bearing in the robot's frame.
struct Bearing {
  double azimuth_rad = 0.0;  ///< counter-clockwise from the robot's heading, in [-pi, pi)
  double elevation_rad = std::numeric_limits<double>::quiet_NaN();  ///< up from the horizontal; NaN: not measured
  Identity identity = kUnknownIdentity;
  Kind kind = kAnyKind;
  /// Standard deviation of the azimuth; NaN: the rig's sigma_bearing_rad.
  double sigma_rad = std::numeric_limits<double>::quiet_NaN();
  /// Distance from the image's centre; NaN: not from an image. An error of the centre changes the azimuth the more, the
  /// smaller this distance is.
  double radius_px = std::numeric_limits<double>::quiet_NaN();
  /// Standard deviation of the elevation; NaN: not known.
  double sigma_elevation_rad = std::numeric_limits<double>::quiet_NaN();
};

/// The appearance of a feature's surroundings (mathematics I.12): 4 x 4 regions of 8 directions, 8 bits each.
struct alignas(32) Descriptor {
  std::array<std::uint8_t, 128> values{};
  friend bool operator==(const Descriptor&, const Descriptor&) = default;
};

/// The features nearest to a feature in its image, by index into the same set, nearest first (mathematics I.14).
struct Neighbours {
  static constexpr std::size_t kMost = 5;
  static constexpr std::uint16_t kNone = 0xffff;
  std::array<std::uint16_t, kMost> index{kNone, kNone, kNone, kNone, kNone};
  friend bool operator==(const Neighbours&, const Neighbours&) = default;
};

/// The reason for not using an image. It accompanies the image's empty bearing set, so that the estimate's health can
/// name it. The numbers are stored in logs and must never change.
enum class ImageTrouble : std::uint8_t {
  none = 0,
  unreadable = 1,   ///< wrong size or format, or cut short
  dark = 2,         ///< hardly any pixel is brighter than black
  overexposed = 3,  ///< most pixels are white
  featureless = 4,  ///< uniform grey: lens covered or out of focus
  frozen = 5,       ///< the same image repeated
  torn = 6,         ///< rows of two exposures, or missing rows filled up
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

/// Initial capacity for the bearings of one image.
inline constexpr std::size_t kTypicalBearings = 32;

/// All bearings of one image. The set is empty when nothing was found in the image.
struct BearingSet {
  Stamp stamp{};
  std::uint64_t sequence = 0;  ///< counts sets at their source; a gap means sets were lost
  std::vector<Bearing> bearings;
  // One entry per bearing for features that are identified by their appearance; otherwise empty.
  std::vector<Descriptor> descriptors = {};
  std::vector<Neighbours> neighbours = {};
  ImageTrouble trouble = ImageTrouble::none;

  /// Removes all bearings. Storage, stamp and sequence are kept.
  void clear() {
    bearings.clear();
    descriptors.clear();
    neighbours.clear();
    trouble = ImageTrouble::none;
  }
};

/// The predicted bearing of a mapped landmark.
struct ExpectedBearing {
  std::int64_t landmark = 0;  ///< its id in the map
  Kind kind = kAnyKind;
  double azimuth_rad = 0.0;  ///< as Bearing::azimuth_rad
  double gate_rad = 0.0;     ///< gate: largest difference of a matching bearing
  // Predicted elevation, as Bearing::elevation_rad, and its gate; NaN: no prediction.
  double elevation_rad = std::numeric_limits<double>::quiet_NaN();
  double gate_elevation_rad = std::numeric_limits<double>::quiet_NaN();
  /// Standard deviation of the azimuth's innovation; NaN: unknown.
  double sigma_rad = std::numeric_limits<double>::quiet_NaN();
  int rejected_in_row = 0;  ///< number of its bearings rejected since the last accepted one
};

/// Whether a bearing may belong to the landmark. Kind and elevation are compared where both sides have them.
inline bool explains(const ExpectedBearing& expected, const Bearing& seen) {
  // A comparison with NaN is false.
  const bool too_high_or_low =
      std::abs(seen.elevation_rad - expected.elevation_rad) > std::abs(expected.gate_elevation_rad);
  return same_kind(expected.kind, seen.kind) && !too_high_or_low &&
         std::abs(wrap(seen.azimuth_rad - expected.azimuth_rad)) <= expected.gate_rad;
}

}  // namespace azimuth
