// Any datagrams from any senders. The resulting odometry and frames must be valid, in order, and in accessible memory.
//
// Input: one byte of choices, then datagrams, each after one byte (two bits of sender, six of time) and two of length.

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>

#include "drivers/lcm/lcm_frames.hpp"
#include "drivers/lcm/lcm_odometry.hpp"
#include "drivers/wire/plausible.hpp"

namespace azimuth {
namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

/// Takes the new results and compares them with the previous ones.
class Follower {
 public:
  void take_from(LcmOdometry& odometry) {
    OdometryReading reading;
    while (odometry.take(reading)) {
      require(is_plausible(reading.T_odom_body) && std::abs(reading.T_odom_body.heading_rad) <= kPi);
      require(is_plausible_sigma(reading.sigma_gap_m) && is_plausible_sigma(reading.sigma_gap_rad));
      if (last_) require(reading.stamp > last_->stamp && reading.sequence > last_->sequence);
      if (last_) require(reading.origin >= last_->origin);
      last_ = reading;
    }
  }
  void take_from(LcmFrames& frames) {
    Frame frame;
    if (!frames.take(frame)) return;
    require(!frame.bytes().empty());
    require(frame.format().pixels == PixelFormat::mjpeg || frame.view().readable());
    if (held_) require(frame.stamp > held_.stamp);
    // Reads every byte, so that the sanitizer checks the access.
    sum_ += static_cast<unsigned>(std::ranges::count(frame.bytes(), std::byte{1}));
    held_ = std::move(frame);
  }

 private:
  std::optional<OdometryReading> last_;
  Frame held_;
  unsigned sum_ = 0;
};

void feed(Bytes input) {
  if (input.empty()) return;
  const auto take = [&input](std::size_t size) {
    const Bytes taken = input.first(std::min(size, input.size()));
    input = input.subspan(taken.size());
    return taken;
  };
  LcmSourceSettings settings;
  settings.max_frame_mb = 0.02;
  settings.stamps = take(1)[0] == std::byte{0} ? LcmStampKind::sender : LcmStampKind::receipt;
  LcmOdometry odometry(settings);
  LcmFrames frames(settings);
  Follower follower;
  LcmReceipt receipt{stamp_from_us(1'700'000'000'000'000), Duration{}};
  while (input.size() > 3) {
    const Bytes head = take(3);
    const auto choices = std::to_integer<unsigned>(head[0]);
    const std::size_t size = 256U * std::to_integer<std::size_t>(head[1]) + std::to_integer<std::size_t>(head[2]);
    receipt.stamp += Duration{1 + 20'000 * (choices >> 2U)};
    if (const auto packet = decode_lcm_packet(take(size))) {
      odometry.accept(*packet, choices & 3U, receipt);
      frames.accept(*packet, choices & 3U, receipt);
    }
    follower.take_from(odometry);
    follower.take_from(frames);
  }
}

}  // namespace
}  // namespace azimuth

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  azimuth::feed(std::as_bytes(std::span(data, size)));
  return 0;
}
