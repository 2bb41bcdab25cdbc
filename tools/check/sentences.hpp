#pragma once
// Internal to tools/check: what is said of each mistake. Keys are those of rig.toml.

#include <optional>
#include <string>

#include "tools/check/mistakes.hpp"
#include "tools/check/odometry_leaps.hpp"
#include "tools/check/offset_cost.hpp"
#include "tools/drive_fit/creep.hpp"
#include "tools/drive_fit/known_points.hpp"
#include "tools/drive_fit/tilt_calibration.hpp"

namespace azimuth {

/// With the key and the value that fits. `rival`: the drive is as likely with that, which names another key.
std::string sentence_wrong(Mistake mistake, const Rig& said, const RigGuess& found,
                           const std::optional<RigGuess>& rival);
std::string sentence_either(Mistake mistake);
/// `sigma` in the mistake's unit.
std::string sentence_fits(Mistake mistake, const Rig& said, const RigGuess& found, double sigma);
/// What is off for sure, and costs next to nothing.
std::string sentence_nearly(Mistake mistake, const Rig& said, const RigGuess& found, double sigma,
                            const OffsetCost& cost);
/// What is off, but not for sure.
std::string sentence_doubtful(Mistake mistake, const Rig& said, const RigGuess& found, double sigma);
/// sigma 0: nobody knows how well it is known.
std::string sentence_cannot_tell(Mistake mistake, double sigma);
/// Before that one is put right.
std::string sentence_hidden_by(Mistake mistake);
std::string sentence_costs(const OffsetCost& cost);
/// `first_s`: since the first reading.
std::string sentence_leaps(const OdometryLeaps& leaps, double first_s);
std::string sentence_senders(const OdometryLeaps& leaps, double first_s);
std::string sentence_stands(double slow_s);
/// `mended`: with floors that cover it.
std::string sentence_creeps(const Creep& creep, const OdometryRig& mended);
std::string sentence_leans(const TiltCalibration& found, const CameraTilt& said);
std::string sentence_leans_as_said(const TiltCalibration& found);
std::string sentence_distance_wrong(const LengthScale& found, double key);
std::string sentence_distance_fits(const LengthScale& found);

}  // namespace azimuth
