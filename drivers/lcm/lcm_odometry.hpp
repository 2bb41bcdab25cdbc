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

/// What became of the messages on the odometry's channel.
struct LcmOdometryCounts {
  std::uint64_t readings = 0;       ///< handed on
  std::uint64_t missing = 0;        ///< gaps in the sender's sequence numbers
  std::uint64_t malformed = 0;      ///< of another type, or with values that cannot be true
  std::uint64_t other_senders = 0;  ///< not listened to
  std::uint64_t replaced = 0;       ///< not taken in time
  std::uint64_t origins = 0;        ///< times the odometer began anew, the first included
};

/// Odometry that another process sends: odometry_t, or bot_core's pose_t as a cumulative pose in the plane.
///
/// Readings get sequence numbers that ascend strictly, with the gaps of the sender's own. A sender that is another one
/// than before, restarts, or jumps as no wheels do (OdometrySteps) begins a new origin.
///
/// Thread contract: thread-bound; allocates nothing.
class LcmOdometry final : public LcmSink {
 public:
  static constexpr std::size_t kMaxUntaken = 64;  ///< then the oldest give way

  explicit LcmOdometry(const LcmSourceSettings& settings);

  void accept(const LcmPacket& packet, LcmPeer sender, const LcmReceipt& receipt) override;
  /// The oldest reading not taken yet.
  bool take(OdometryReading& reading) { return readings_.pop(reading); }

  /// What the next process needs to go on with the present sender; false: there is none.
  bool remember(OdometerMemory& out) const;
  /// Before anything is accepted: readings of the same sender go on in the same origin, if it has neither restarted nor
  /// jumped. Others begin at another one.
  void restore(const OdometerMemory& memory);

  const LcmOdometryCounts& counts() const { return counts_; }
  const LcmStampCounts& stamp_counts() const { return stamps_.counts(); }
  std::uint64_t senders() const { return senders_.changes(); }  ///< listened to so far

 private:
  struct Said {
    OdometryReading reading;   ///< as the sender has it
    bool is_bot_pose = false;  ///< which has neither sequence nor origin
  };
  static bool decode(Bytes message, Said& said);
  void charge_silence(Duration silence);
  void follow(const Said& said, bool is_new_sender);
  bool begins_anew(const Said& said) const;

  std::string channel_;
  LcmSenderChoice senders_;
  LcmStamps stamps_;
  Said last_said_;
  OdometryReading reading_;  // handed on last
  std::uint32_t origin_ = 0;
  bool restored_ = false;  // and nothing was heard since
  OdometrySteps steps_;
  Ring<OdometryReading, kMaxUntaken> readings_;
  LcmOdometryCounts counts_;
};

}  // namespace azimuth
