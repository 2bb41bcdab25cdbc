#pragma once
// Mistakes that a rig or a recording may contain, with one table row for each.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "tools/drive_fit/drive_graph.hpp"

namespace azimuth {

/// Mistakes that hide others come first.
enum class Mistake : std::uint8_t {
  leaps,     ///< odometry moves as no wheel can: wheel counts wrap or the odometer restarts
  senders,   ///< the recording mixes odometry of two senders
  hand,      ///< azimuths grow in the opposite direction
  wheels,    ///< odometry reports turns with the wrong sign
  heading,   ///< wrong yaw of the camera
  turn,      ///< wrong scale of turns
  drift,     ///< wrong heading drift per metre
  lag,       ///< wrong time offset between odometry and camera
  clock,     ///< the time offset grows
  jump,      ///< the time offset changes at one instant
  mount,     ///< wrong position of the camera on the robot
  centre,    ///< wrong centre of the image
  tilt,      ///< wrong roll or pitch of the camera
  creep,     ///< odometry reports motion while the robot stands
  distance,  ///< wrong scale of distances
};
inline constexpr std::size_t kMistakes = 15;

/// Difference of a number from the rig's value and its standard deviation, both in the mistake's unit.
struct Off {
  double by = 0.0, sigma = 0.0;
};

struct MistakeRow {
  Mistake mistake;
  std::string_view name;
  /// An offset larger than this is gross, independent of its cost in metres; in the mistake's unit. The check can
  /// confirm a number only if its standard deviation is at most half of this.
  double gross;
  /// Conversion factor from the mistake's unit to `unit`, which texts for the user use.
  double per_unit;
  std::string_view unit;
  /// Advice: which motion or which file makes the mistake observable.
  std::string_view tells;
  /// "key = value" for rig.toml with the found value. Null if the table provides none.
  std::string (*key)(const Rig& said, const RigGuess& found);
  /// Description of the mistake, without the key. Null if the table provides none.
  std::string (*wrong)(const Rig& said, const RigGuess& found);
  /// Offset of the found number from the present one. Null if the mistake has no number that a fit estimates.
  Off (*off)(const DriveSolution& found, const DriveSolution& now, double drive_s);
};

const MistakeRow& row_of(Mistake mistake);
inline std::string_view to_string(Mistake mistake) { return row_of(mistake).name; }

/// True for the two mistakes that mirror the world. Each explains a drive as well as the other; only knowledge of the
/// true path or map separates them.
inline bool is_of_two_worlds(Mistake mistake) { return mistake == Mistake::hand || mistake == Mistake::wheels; }

}  // namespace azimuth
