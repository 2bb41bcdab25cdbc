#pragma once
// Whether bearings and odometry of a drive can be what the rig says, and if not, what is likeliest to be wrong.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drivers/storage/run.hpp"
#include "tools/drive_fit/drive_graph.hpp"

namespace azimuth {

/// What may be wrong with a rig, or with the way in which a run was recorded.
enum class Mistake : std::uint8_t {
  hand,      ///< azimuths grow the other way
  wheels,    ///< turns are reported the other way round
  heading,   ///< the camera looks elsewhere
  turn,      ///< scale of turns
  drift,     ///< heading gained for each metre
  lag,       ///< odometry is late, or the camera
  clock,     ///< a lag that grows
  centre,    ///< of the image
  distance,  ///< scale of distances
};
inline constexpr std::size_t kMistakes = 9;
std::string_view to_string(Mistake mistake);

/// What came of looking for one of them.
struct MistakeVerdict {
  Mistake mistake = Mistake::hand;
  enum class Says : std::uint8_t { fits, wrong, cannot_tell } says = Says::cannot_tell;
  std::string sentence;   ///< for a person, with the key to change and its value where something is wrong
  double evidence = 0.0;  ///< of `wrong`: ln of how many times likelier the drive is with that value
};

struct Plausibility {
  std::vector<MistakeVerdict> verdicts;  ///< one for each mistake, in their order
  Rig rig;                               ///< with all that is wrong put right
  double fitting = 0.0;                  ///< share of the bearings that fit, with that

  bool anything_wrong() const;
};

/// A mistake is named when the drive is ten thousand times likelier without it, each number that is adjusted charged as
/// by Schwarz's criterion, when the number is four standard deviations from what the rig says, and when it matters: see
/// what_matters(). Several are named one after another, the likeliest first (SPEC VI.26).
///
/// The run's truth and its surveyed landmarks, where it has any, tell the scale of distances and which of two mirrored
/// worlds is the true one, and nothing else. The drive has sets of bearings.
Plausibility judge(const Drive& drive, const Run& run, const Rig& rig, const HindsightSettings& settings);

/// Less than this is no mistake, but what calibration is for: in the mistake's own unit.
double what_matters(Mistake mistake);

}  // namespace azimuth
