#pragma once
// Internal to tools/check: what is said of each mistake. Keys are those of rig.toml.

#include <optional>
#include <string>

#include "tools/check/plausibility.hpp"
#include "tools/drive_fit/known_points.hpp"

namespace azimuth {

/// With the key and the value that fits. `rival`: the drive is as likely with that, which names another key.
std::string sentence_wrong(Mistake mistake, const Rig& said, const RigGuess& found,
                           const std::optional<RigGuess>& rival);
std::string sentence_either(Mistake mistake);
/// `sigma` in the unit of what_matters().
std::string sentence_fits(Mistake mistake, const Rig& said, const RigGuess& found, double sigma);
std::string sentence_cannot_tell(Mistake mistake, double sigma);
std::string sentence_distance_wrong(const LengthScale& found, double key);
std::string sentence_distance_fits(const LengthScale& found);

}  // namespace azimuth
