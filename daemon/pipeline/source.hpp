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

inline constexpr std::size_t kOdometryRing = 256;  ///< OdometryTrack must look back over twice as many readings
inline constexpr std::size_t kBearingsRing = 64;

inline constexpr std::size_t kMaxSources = 2;  ///< of a pipeline

using OdometryWire = EveryOne<OdometryReading, kOdometryRing>;
using BearingsWire = EveryOne<BearingSet, kBearingsRing>;
using FramesWire = Newest<Frame>;

/// What happened to a device, for the log.
struct DeviceEvent {
  bool trouble = false;
  std::string text;
  bool port_reset = false;       ///< its port was reset, or that was tried
  std::string_view device = {};  ///< the source's name; the pipeline fills it in
};

/// The near ends of the wires that lead from one source.
struct SourceWires {
  OdometryWire& odometry;
  // At most one of the two is there: a rig's bearings come ready made, or are found in images.
  BearingsWire* bearings;  ///< null: nobody wants ready-made ones
  FramesWire* frames;      ///< null: nobody looks at images
  Newest<DeviceStatus>& status;
  EveryOne<DeviceEvent, 16>& events;
};

/// Where samples come from: a recording, the robot's odometer, its camera.
///
/// At most one source of a pipeline sends odometry and at most one bearings or frames; a played one sends both and is
/// alone.
///
/// Thread contract: turn() and remember() belong to one thread of the pipeline; restore() is called before that starts,
/// close() when it has ended.
class Source {
 public:
  virtual ~Source() = default;

  /// Of its thread, at most 15 characters.
  virtual const char* name() const = 0;

  /// One bounded piece of work: hands over what there is, and sleeps on `bell` (and on its own device) while there is
  /// nothing. False: no sample will come any more.
  virtual bool turn(Doorbell& bell, SourceWires& wires) = 0;

  /// Before the first turn: the odometry goes on from what another process remembered, if the robot's counters agree.
  /// If they do not, its readings are of another origin. Of a source that sends no odometry: nothing to do.
  virtual void restore(const OdometerMemory& memory) = 0;
  /// What the next process's source is to be given; also after close(). False: nothing.
  virtual bool remember(OdometerMemory& /*out*/) const { return false; }

  /// Takes leave of the device, within 500 ms.
  virtual void close() {}
};

}  // namespace azimuth
