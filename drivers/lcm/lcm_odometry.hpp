#pragma once
#include <cstdint>
#include <string>

#include "base/ring.hpp"
#include "drivers/device/odometer_memory.hpp"
#include "drivers/lcm/lcm_settings.hpp"
#include "drivers/lcm/lcm_sink.hpp"
#include "drivers/lcm/lcm_stamps.hpp"
#include "slam/sample/odometry.hpp"
#include "slam/sample/odometry_steps.hpp"

namespace azimuth {

/// The counters of messages on the odometry's channel.
struct LcmOdometryCounts {
  std::uint64_t readings = 0;       ///< delivered readings
  std::uint64_t missing = 0;        ///< gaps in the sender's sequence numbers
  std::uint64_t malformed = 0;      ///< messages of another type, or with implausible values
  std::uint64_t other_senders = 0;  ///< messages of senders that are ignored
  std::uint64_t replaced = 0;       ///< readings not taken in time
  std::uint64_t origins = 0;        ///< number of origins, including the first
};

/// Odometry that another process sends: odometry_t, or bot_core's pose_t as a cumulative pose in the plane.
///
/// The sequence numbers of the readings strictly increase, with the gaps of the sender's own numbers. A new origin
/// starts when the sender changes, restarts, or makes a step that wheels cannot make (OdometrySteps).
///
/// Thread contract: thread-bound; allocates nothing.
class LcmOdometry final : public LcmSink {
 public:
  static constexpr std::size_t kMaxUntaken = 64;  ///< beyond this, the oldest reading is dropped

  explicit LcmOdometry(const LcmSourceSettings& settings);

  void accept(const LcmPacket& packet, LcmPeer sender, const LcmReceipt& receipt) override;
  /// Takes the oldest reading.
  bool take(OdometryReading& reading) { return readings_.pop(reading); }

  /// Writes the state that the next process needs to continue with the current sender. False: there is none.
  bool remember(OdometerMemory& out) const;
  /// Called before anything is accepted. Readings of the same sender continue in the same origin, if it has neither
  /// restarted nor jumped. Readings of other senders start another origin.
  void restore(const OdometerMemory& memory);

  const LcmOdometryCounts& counts() const { return counts_; }
  const LcmStampCounts& stamp_counts() const { return stamps_.counts(); }
  std::uint64_t senders() const { return senders_.changes(); }  ///< number of senders used so far

 private:
  struct Said {
    OdometryReading reading;   ///< in the sender's frame
    bool is_bot_pose = false;  ///< a bot_core pose has neither sequence nor origin
  };
  static bool decode(Bytes message, Said& said);
  void charge_silence(Duration silence);
  void follow(const Said& said, bool is_new_sender);
  bool begins_anew(const Said& said) const;

  std::string channel_;
  LcmSenderChoice senders_;
  LcmStamps stamps_;
  Said last_said_;
  OdometryReading reading_;  // the reading delivered last
  std::uint32_t origin_ = 0;
  bool restored_ = false;  // true: nothing has been received since restore()
  OdometrySteps steps_;
  Ring<OdometryReading, kMaxUntaken> readings_;
  LcmOdometryCounts counts_;
};

}  // namespace azimuth
