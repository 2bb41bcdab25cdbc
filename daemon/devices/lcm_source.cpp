#include "daemon/devices/lcm_source.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <span>
#include <utility>

#include "daemon/pipeline/nap.hpp"
#include "drivers/device/clock_duration.hpp"

namespace azimuth {
namespace {

using Loss = std::pair<std::uint64_t, const char*>;

void append_losses(std::span<const Loss> losses, std::string& words) {
  for (const auto& [count, what] : losses)
    if (count > 0) fmt::format_to(std::back_inserter(words), ", {} {}", count, what);
}

void append_losses(const LcmStampCounts& counts, std::string& words) {
  append_losses(std::array<Loss, 3>{{{counts.too_old, "with stamps too old"},
                                     {counts.in_future, "with stamps in the future"},
                                     {counts.out_of_order, "out of order"}}},
                words);
}

/// Stamps that are decades off are no matter of clocks that were set badly.
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

bool LcmSource::turn(Doorbell& bell, SourceWires& wires) {
  receiver_.turn(Clock::now(), sink());
  const Clock::time_point now = Clock::now();
  if (pass_on(wires)) {
    any_sample_ = true;
    last_sample_ = now;
  }
  if (stamp_counts().misdated() != std::exchange(misdated_, stamp_counts().misdated())) last_misdated_ = now;
  report(wires, now);
  const auto until_due = receiver_.next_turn() - Clock::now();
  bell.wait_also(receiver_.descriptor(), POLLIN, std::min<std::chrono::nanoseconds>(kNap, until_due));
  return true;
}

LcmSource::Condition LcmSource::condition(Clock::time_point now) const {
  if (!receiver_.state().open) return Condition::unconnected;
  if (any_sample_ && now - last_sample_ <= setup_.silent_after) return Condition::running;
  return misdated_ > 0 && now - last_misdated_ <= setup_.silent_after ? Condition::misdated : Condition::silent;
}

/// Into the status, whose storage is used again: once a second is often enough to matter.
void LcmSource::describe(Condition condition) {
  std::string& words = status_.text;
  words.clear();
  auto out = std::back_inserter(words);
  if (condition == Condition::unconnected) {
    words = receiver_.state().trouble;
  } else if (condition == Condition::silent) {
    fmt::format_to(out, "silent: nothing of use on {}", setup_.channel);
  } else if (condition == Condition::misdated) {
    append_clocks(stamp_counts().last_off_s, setup_.channel, words);
  } else {
    fmt::format_to(out, "running ({})", setup_.channel);
  }
  describe_losses(words);
  append_losses(stamp_counts(), words);
  const LcmReceiverState& receiver = receiver_.state();
  append_losses(std::array<Loss, 2>{{{receiver.malformed, "datagrams not of LCM"},
                                     {receiver.kernel_dropped, "datagrams the kernel had no room for"}}},
                words);
}

void LcmSource::report(SourceWires& wires, Clock::time_point now) {
  const Condition current = condition(now);
  const bool is_change = pace_.is_change(current);
  if (!pace_.due(current, now)) return;
  describe(current);
  status_.works = current == Condition::running;
  status_.reconnects = senders() > 0 ? senders() - 1 : 0;
  if (is_change) {
    DeviceEvent event{!status_.works, std::string(setup_.device) + ": " + status_.text};
    wires.events.push(event);
  }
  wires.status.publish(status_);
}

LcmOdometerSource::LcmOdometerSource(const LcmSourceSettings& settings, const LcmAddress& address,
                                     Duration epoch_minus_monotonic)
    : LcmSource(
          {"odometer", settings.odometry_channel, address, epoch_minus_monotonic, clock_duration(settings.silent_s)}),
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
  append_losses(std::array<Loss, 4>{{{counts.missing, "missing"},
                                     {counts.malformed, "malformed"},
                                     {counts.other_senders, "of other senders"},
                                     {counts.replaced, "replaced"}}},
                words);
}

LcmCameraSource::LcmCameraSource(const LcmSourceSettings& settings, const LcmAddress& address,
                                 Duration epoch_minus_monotonic)
    : LcmSource({"camera", settings.frames_channel, address, epoch_minus_monotonic, clock_duration(settings.silent_s)}),
      frames_(settings) {}

bool LcmCameraSource::pass_on(SourceWires& wires) {
  if (!frames_.take(frame_)) return false;
  if (wires.frames) wires.frames->publish(frame_);
  frame_ = Frame{};  // an unwanted one, or the one that was replaced
  return true;
}

void LcmCameraSource::describe_losses(std::string& words) const {
  const LcmFrameCounts& counts = frames_.counts();
  append_losses(std::array<Loss, 7>{{{counts.incomplete, "incomplete"},
                                     {counts.malformed, "malformed"},
                                     {counts.unsupported, "of an unknown format"},
                                     {counts.too_large, "too large"},
                                     {counts.no_room, "without room"},
                                     {counts.other_senders, "of other senders"},
                                     {counts.replaced, "replaced"}}},
                words);
}

}  // namespace azimuth
