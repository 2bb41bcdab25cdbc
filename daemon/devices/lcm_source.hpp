#pragma once
#include <chrono>
#include <cstdint>
#include <string>

#include "daemon/devices/polled_source.hpp"
#include "drivers/lcm/lcm_frames.hpp"
#include "drivers/lcm/lcm_odometry.hpp"
#include "drivers/lcm/lcm_receiver.hpp"

namespace azimuth {

/// The common base of LcmOdometerSource and LcmCameraSource: it has a receiver and reports its state.
class LcmSource : public PolledSource {
 protected:
  struct Setup {
    std::string channel;
    LcmAddress address;
    Duration epoch_minus_monotonic;
    Clock::duration silent_after;
  };
  explicit LcmSource(const Setup& setup);

 private:
  void work(Clock::time_point now, SourceWires& wires) final;
  std::optional<DeviceCondition> condition() const final { return condition_; }
  void describe(DeviceStatus& status) const final;
  Polled polled() const final { return only(receiver_.descriptor(), POLLIN); }
  Clock::duration due_in(Clock::time_point now) const final { return receiver_.next_turn() - now; }
  bool status_is_news() const final { return true; }

  virtual LcmSink& sink() = 0;
  /// Sends the received samples on. False: there were none.
  virtual bool pass_on(SourceWires& wires) = 0;
  virtual std::uint64_t senders() const = 0;
  virtual const LcmStampCounts& stamp_counts() const = 0;
  /// Appends losses and their causes, e.g. ", 3 malformed". Losses caused by stamps are not included.
  virtual void describe_losses(std::string& words) const = 0;

  DeviceCondition judge(Clock::time_point now) const;

  Setup setup_;
  LcmReceiver receiver_;
  bool any_sample_ = false;
  Clock::time_point last_sample_{}, last_misdated_{};
  std::uint64_t misdated_ = 0;  // samples with a wrong stamp so far
  DeviceCondition condition_;
};

/// Wheel odometry that another process sends over LCM (drivers/lcm/lcm_odometry.hpp).
class LcmOdometerSource final : public LcmSource {
 public:
  /// Stamps on arrival are CLOCK_MONOTONIC plus `epoch_minus_monotonic`. `address` is the parsed URL of `settings`.
  LcmOdometerSource(const LcmSourceSettings& settings, const LcmAddress& address, Duration epoch_minus_monotonic);

  const char* name() const override { return "odometer"; }
  void restore(const OdometerMemory& memory) override { odometry_.restore(memory); }
  bool remember(OdometerMemory& out) const override { return odometry_.remember(out); }

 private:
  LcmSink& sink() override { return odometry_; }
  bool pass_on(SourceWires& wires) override;
  std::uint64_t senders() const override { return odometry_.senders(); }
  const LcmStampCounts& stamp_counts() const override { return odometry_.stamp_counts(); }
  void describe_losses(std::string& words) const override;

  LcmOdometry odometry_;
  OdometryReading reading_;
};

/// Images that another process sends over LCM (drivers/lcm/lcm_frames.hpp).
class LcmCameraSource final : public LcmSource {
 public:
  /// Parameters as for LcmOdometerSource.
  LcmCameraSource(const LcmSourceSettings& settings, const LcmAddress& address, Duration epoch_minus_monotonic);

  const char* name() const override { return "camera"; }
  void restore(const OdometerMemory& /*memory*/) override {}  // a camera has no odometry

 private:
  LcmSink& sink() override { return frames_; }
  bool pass_on(SourceWires& wires) override;
  std::uint64_t senders() const override { return frames_.senders(); }
  const LcmStampCounts& stamp_counts() const override { return frames_.stamp_counts(); }
  void describe_losses(std::string& words) const override;

  LcmFrames frames_;
  Frame frame_;
};

}  // namespace azimuth
