#pragma once
#include <cstddef>
#include <string>
#include <string_view>

#include "daemon/pipeline/doorbell.hpp"
#include "daemon/pipeline/wires.hpp"
#include "daemon/publish/status.hpp"
#include "drivers/camera/frame.hpp"
#include "drivers/device/odometer_memory.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

inline constexpr std::size_t kOdometryRing = 256;  ///< OdometryTrack must hold at least twice as many readings.
inline constexpr std::size_t kBearingsRing = 64;

inline constexpr std::size_t kMaxSources = 2;  ///< largest number of sources of a pipeline

using OdometryWire = EveryOne<OdometryReading, kOdometryRing>;
using BearingsWire = EveryOne<BearingSet, kBearingsRing>;
using FramesWire = Newest<Frame>;

/// A change in the state of a device, for the log.
struct DeviceEvent {
  bool trouble = false;
  std::string text;
  bool port_reset = false;       ///< The USB port was reset, or a reset was tried.
  std::string_view device = {};  ///< name of the source; the pipeline fills it in
};

/// The writing ends of the wires of one source.
struct SourceWires {
  OdometryWire& odometry;
  // At most one of these two is set: bearings are either ready made or found in images.
  BearingsWire* bearings;  ///< null: ready-made bearings are not wanted
  FramesWire* frames;      ///< null: images are not wanted
  Newest<DeviceStatus>& status;
  EveryOne<DeviceEvent, 16>& events;
};

/// An origin of samples: a recording, the robot's odometer or its camera.
///
/// At most one source of a pipeline sends odometry, and at most one sends bearings or frames. A played recording sends
/// both and is the only source.
///
/// Thread contract: turn() and remember() belong to one thread of the pipeline. restore() is called before that thread
/// starts, close() after it has ended.
class Source {
 public:
  virtual ~Source() = default;

  /// Name of the source's thread, at most 15 characters.
  virtual const char* name() const = 0;

  /// Does one bounded piece of work: hands over the samples that have arrived, or sleeps on `bell` (and on its own
  /// device) while there are none. False: no sample will come any more.
  virtual bool turn(Doorbell& bell, SourceWires& wires) = 0;

  /// Called before the first turn. The odometry continues from the state that another process kept, if the robot's
  /// counters agree with it. If they do not agree, the readings get a new origin. A source without odometry does
  /// nothing.
  virtual void restore(const OdometerMemory& memory) = 0;
  /// Writes the state that the source of the next process is to continue from. May also be called after close(). False:
  /// there is none.
  virtual bool remember(OdometerMemory& /*out*/) const { return false; }

  /// Ends the conversation with the device, within 500 ms.
  virtual void close() {}
};

}  // namespace azimuth
