#include "daemon/devices/lcm_source.hpp"

#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <utility>

#include "daemon/devices/status_words.hpp"
#include "drivers/device/device_clock.hpp"

namespace azimuth {
namespace {

constexpr DeviceCondition kMisdated{Connection::silent, "misdated"};

/// A difference of decades is not caused by a badly set clock, so another cause is suggested.
void append_clocks(double off_s, const std::string& channel, std::string& words) {
  constexpr double kDecade_s = 3e8;
  auto out = std::back_inserter(words);
  if (std::abs(off_s) > kDecade_s) {
    fmt::format_to(out, "{} has stamps years from this machine's clock: is utime in microseconds?", channel);
  } else {
    fmt::format_to(out,
                   "{} is stamped by a clock {:.1f} s {} this machine's: synchronise them, or set "
                   "daemon.lcm_source.stamps = \"receipt\"",
                   channel, std::abs(off_s), off_s < 0.0 ? "behind" : "ahead of");
  }
}

}  // namespace

LcmSource::LcmSource(const Setup& setup) : setup_(setup), receiver_(setup.address, setup.epoch_minus_monotonic) {}

void LcmSource::work(Clock::time_point before, SourceWires& wires) {
  receiver_.turn(before, sink());
  const Clock::time_point now = Clock::now();
  if (pass_on(wires)) {
    any_sample_ = true;
    last_sample_ = now;
  }
  if (stamp_counts().misdated() != std::exchange(misdated_, stamp_counts().misdated())) last_misdated_ = now;
  condition_ = judge(now);
}

DeviceCondition LcmSource::judge(Clock::time_point now) const {
  if (!receiver_.state().open) return kAway;
  if (any_sample_ && now - last_sample_ <= setup_.silent_after) return kRunning;
  return misdated_ > 0 && now - last_misdated_ <= setup_.silent_after ? kMisdated : kSilent;
}

void LcmSource::describe(DeviceStatus& status) const {
  const LcmReceiverState& receiver = receiver_.state();
  const LcmStampCounts& stamps = stamp_counts();
  std::string& words = status.text;
  words.clear();
  auto out = std::back_inserter(words);
  if (condition_ == kAway) {
    words = receiver.trouble;
  } else if (condition_ == kSilent) {
    fmt::format_to(out, "silent: nothing of use on {}", setup_.channel);
  } else if (condition_ == kMisdated) {
    append_clocks(stamps.last_off_s, setup_.channel, words);
  } else {
    fmt::format_to(out, "running ({})", setup_.channel);
  }
  describe_losses(words);
  append_losses({{stamps.too_old, "with stamps too old"},
                 {stamps.in_future, "with stamps in the future"},
                 {stamps.out_of_order, "out of order"},
                 {receiver.malformed, "datagrams not of LCM"},
                 {receiver.kernel_dropped, "datagrams the kernel had no room for"}},
                words);
  status.reconnects = senders() > 0 ? senders() - 1 : 0;
}

LcmOdometerSource::LcmOdometerSource(const LcmSourceSettings& settings, const LcmAddress& address,
                                     Duration epoch_minus_monotonic)
    : LcmSource({settings.odometry_channel, address, epoch_minus_monotonic, clock_duration(settings.silent_s)}),
      odometry_(settings) {}

bool LcmOdometerSource::pass_on(SourceWires& wires) {
  bool any = false;
  while (odometry_.take(reading_)) {
    any = true;
    wires.odometry.push(reading_);
  }
  return any;
}

void LcmOdometerSource::describe_losses(std::string& words) const {
  const LcmOdometryCounts& counts = odometry_.counts();
  append_losses({{counts.missing, "missing"},
                 {counts.malformed, "malformed"},
                 {counts.other_senders, "of other senders"},
                 {counts.replaced, "replaced"}},
                words);
}

LcmCameraSource::LcmCameraSource(const LcmSourceSettings& settings, const LcmAddress& address,
                                 Duration epoch_minus_monotonic)
    : LcmSource({settings.frames_channel, address, epoch_minus_monotonic, clock_duration(settings.silent_s)}),
      frames_(settings) {}

bool LcmCameraSource::pass_on(SourceWires& wires) {
  if (!frames_.take(frame_)) return false;
  if (wires.frames) wires.frames->publish(frame_);
  frame_ = Frame{};  // releases an unwanted frame, or the frame that publish() replaced
  return true;
}

void LcmCameraSource::describe_losses(std::string& words) const {
  const LcmFrameCounts& counts = frames_.counts();
  append_losses({{counts.incomplete, "incomplete"},
                 {counts.malformed, "malformed"},
                 {counts.unsupported, "of an unknown format"},
                 {counts.too_large, "too large"},
                 {counts.no_room, "without room"},
                 {counts.other_senders, "of other senders"},
                 {counts.replaced, "replaced"}},
                words);
}

}  // namespace azimuth
