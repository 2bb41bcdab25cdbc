#pragma once
// Internal to tools/check: sentences for the user about each mistake. Keys are those of rig.toml.

#include <optional>
#include <string>

#include "tools/check/mistakes.hpp"
#include "tools/check/odometry_leaps.hpp"
#include "tools/check/offset_cost.hpp"
#include "tools/drive_fit/creep.hpp"
#include "tools/drive_fit/known_points.hpp"
#include "tools/drive_fit/tilt_calibration.hpp"

namespace azimuth {

/// Describes the mistake, with the key to change and the value that fits. Two mistakes mirror the world (see
/// is_of_two_worlds()). If the drive cannot tell them apart, `rival` is the guess for the other one, and the sentence
/// names both keys.
std::string sentence_wrong(Mistake mistake, const Rig& said, const RigGuess& found,
                           const std::optional<RigGuess>& rival);
std::string sentence_either(Mistake mistake);
/// `sigma`: standard deviation in the mistake's unit, here and below.
std::string sentence_fits(Mistake mistake, const Rig& said, const RigGuess& found, double sigma);
/// Describes a number that differs significantly from the fitted one but hardly changes the robot's position.
std::string sentence_nearly(Mistake mistake, const Rig& said, const RigGuess& found, double sigma,
                            const OffsetCost& cost);
/// Describes a number that differs from the fitted one, but not significantly.
std::string sentence_doubtful(Mistake mistake, const Rig& said, const RigGuess& found, double sigma);
/// `sigma` is 0 if the uncertainty is unknown.
std::string sentence_cannot_tell(Mistake mistake, double sigma);
/// Says that nothing can be told before `mistake` is corrected.
std::string sentence_hidden_by(Mistake mistake);
std::string sentence_costs(const OffsetCost& cost);
/// `first_s`: time of the first leap since the first reading [s].
std::string sentence_leaps(const OdometryLeaps& leaps, double first_s);
std::string sentence_senders(const OdometryLeaps& leaps, double first_s);
std::string sentence_stands(double slow_s);
/// `mended`: the odometry rig with floors that cover the creep.
std::string sentence_creeps(const Creep& creep, const OdometryRig& mended);
std::string sentence_leans(const TiltCalibration& found, const CameraTilt& said);
std::string sentence_leans_as_said(const TiltCalibration& found);
std::string sentence_distance_wrong(const LengthScale& found, double key);
std::string sentence_distance_fits(const LengthScale& found);

}  // namespace azimuth
