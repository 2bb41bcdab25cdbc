#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "drivers/can/can_settings.hpp"
#include "drivers/can/can_signal.hpp"
#include "drivers/can/dbc.hpp"

namespace azimuth {

/// One of the signals that odometry is made of.
struct CanMotionSignal {
  CanSignal signal;
  double unit = 1.0;           ///< metres, m/s or radians per unit of the signal; negative: reversed
  double fastest_per_s = 1.0;  ///< no change of the quantity is faster (of a speed: the fastest itself)
};

/// A signal that says yes or no.
struct CanFlagSignal {
  CanSignal signal;
  std::uint64_t mask = ~std::uint64_t{0};
  std::optional<std::uint64_t> value{};  ///< of those bits when it is yes; nothing: any but zero
};

/// Where what the settings name is to be found in which frames.
struct CanLayout {
  CanOdometryKind odometry = CanOdometryKind::ticks;
  std::vector<CanMotionSignal> motion;  ///< left and right, or x, y and heading
  double track_m = 1.0;                 ///< of ticks and speeds
  std::optional<CanSignal> battery;
  std::optional<CanFlagSignal> emergency_stop, bumper, charging;

  /// The frames that are wanted, each once.
  std::vector<CanId> ids() const;
};

/// Finds the signals that the settings name: in the settings themselves, else in `dbc` (null: no file). Every mistake
/// is an error whose file is the setting's name.
FileResult<CanLayout> find_can_layout(const CanSettings& settings, const Dbc* dbc);

/// The signal that settings describe, apart from its multiplexer.
CanSignal described_signal(const CanSignalSettings& settings);

}  // namespace azimuth
