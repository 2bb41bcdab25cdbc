#pragma once
// What may be wrong with a rig, or with the way in which a run was recorded: one row for each.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "tools/drive_fit/drive_graph.hpp"

namespace azimuth {

/// Those that hide others stand first.
enum class Mistake : std::uint8_t {
  leaps,     ///< odometry goes a way that no wheel makes: counts that wrap, an odometer that begins anew
  senders,   ///< odometry of two, mixed
  hand,      ///< azimuths grow the other way
  wheels,    ///< turns are reported the other way round
  heading,   ///< the camera looks elsewhere
  turn,      ///< scale of turns
  drift,     ///< heading gained for each metre
  lag,       ///< odometry is late, or the camera
  clock,     ///< a lag that grows
  jump,      ///< a lag that is another one from an instant on
  mount,     ///< the camera stands elsewhere than over the axle
  centre,    ///< of the image
  tilt,      ///< the camera leans
  creep,     ///< the odometer goes on while the robot stands
  distance,  ///< scale of distances
};
inline constexpr std::size_t kMistakes = 15;

/// How far a number is from what the rig says, in the mistake's own unit.
struct Off {
  double by = 0.0, sigma = 0.0;
};

struct MistakeRow {
  Mistake mistake;
  std::string_view name;
  /// More than this is gross, whatever it costs: own unit. A number that is known to no better than half of it cannot
  /// be told to be right.
  double gross;
  /// For a person: so many of these are one of its own.
  double per_unit;
  std::string_view unit;
  /// Which motion or which file would tell.
  std::string_view tells;
  /// "key = value" of what was found. None: of no rig.
  std::string (*key)(const Rig& said, const RigGuess& found);
  /// What is wrong, without the key.
  std::string (*wrong)(const Rig& said, const RigGuess& found);
  /// None: it has no number that a fit finds.
  Off (*off)(const DriveSolution& found, const DriveSolution& now, double drive_s);
};

const MistakeRow& row_of(Mistake mistake);
inline std::string_view to_string(Mistake mistake) { return row_of(mistake).name; }

/// Either explains what the other one does, but for what is known of the world.
inline bool is_of_two_worlds(Mistake mistake) { return mistake == Mistake::hand || mistake == Mistake::wheels; }

}  // namespace azimuth
