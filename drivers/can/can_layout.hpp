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

/// A signal from which odometry is computed.
struct CanMotionSignal {
  CanSignal signal;
  double unit = 1.0;  ///< metres, m/s or radians per unit of the signal; negative: reversed
  /// Largest rate of change of the quantity per second; for a speed, the largest speed itself.
  double fastest_per_s = 1.0;
};

/// The position of each configured signal in its frame.
struct CanLayout {
  CanOdometryKind odometry = CanOdometryKind::ticks;
  std::vector<CanMotionSignal> motion;  ///< left and right wheel, or x, y and heading
  double track_m = 1.0;                 ///< used for ticks and speeds
  std::optional<CanSignal> battery;
  std::optional<CanSignal> emergency_stop, bumper, charging;

  /// Identifiers of the frames that are read, each once.
  std::vector<CanId> ids() const;
};

/// Finds the signals that the settings name: in the settings themselves, otherwise in `dbc` (null: no file). Every
/// mistake becomes an error whose file is the name of the setting.
FileResult<CanLayout> find_can_layout(const CanSettings& settings, const Dbc* dbc);

/// The signal described by the settings, without its multiplexer.
CanSignal described_signal(const CanSignalSettings& settings);

}  // namespace azimuth
