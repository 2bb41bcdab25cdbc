// Any datagrams as input of a CAN socket. Frames must survive encoding, signals must lie within their frame or count as
// missing, and readings must be finite and in order.

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "drivers/can/can_driver.hpp"
#include "drivers/can/can_frame.hpp"
#include "drivers/can/can_odometer.hpp"
#include "tests/drivers/can/fake_base.hpp"

namespace azimuth {
namespace {

using Bytes = std::span<const std::uint8_t>;

void require(bool condition) {
  if (!condition) std::abort();
}

void check_frame(const CanFrame& frame) {
  if (frame.kind == CanFrame::Kind::remote) return;
  std::array<std::uint8_t, kMostCanSocketBytes> datagram{};
  const std::size_t size = encode_can_frame(frame, datagram);
  require(decode_can_frame(std::span(datagram).first(size)) == frame);
}

/// A signal at any bit position, including positions outside the frame.
void check_signal(Bytes where, const CanFrame& frame) {
  const CanBits bits{where[0] + 2 * where[1], 1 + where[2] % 64,
                     where[3] % 2 == 0 ? CanByteOrder::intel : CanByteOrder::motorola};
  const bool fits = bytes_needed(bits) <= static_cast<int>(frame.size);
  const auto number = read_bits(bits, frame.bytes());
  require(number.has_value() == fits);
  if (!fits) return;
  CanFrame copy = frame;
  write_bits(bits, *number, {copy.data.data(), copy.size});
  require(copy == frame);
}

/// Input of a base, one datagram after the other: a byte for the elapsed time, a byte for the id, then the data.
class Script {
 public:
  explicit Script(const CanLayout& layout) : layout_(layout), odometer_(layout, {}, Duration{0}) {}

  void play(Bytes script) {
    while (script.size() >= 10) {
      at_ += std::chrono::milliseconds(script[0] * script[0] / 16);
      CanFrame frame = test::empty_frame(layout_.motion[script[1] % layout_.motion.size()].signal.frame);
      frame.size = script[1] >= 240 ? script[1] % 9 : 8;
      std::copy_n(script.begin() + 2, frame.size, frame.data.begin());
      if (script[1] % 16 == 15) frame.kind = CanFrame::Kind::error;
      bus_.add(frame);
      check(odometer_.add(frame, at_));
      script = script.subspan(10);
    }
  }

 private:
  void check(const std::optional<OdometryReading>& reading) {
    if (!reading) return;
    const Pose2& pose = reading->T_odom_body;
    require(std::isfinite(pose.x_m) && std::isfinite(pose.y_m));
    require(pose.heading_rad >= -kPi && pose.heading_rad < kPi);
    require(std::isfinite(reading->sigma_gap_m) && reading->sigma_gap_m >= 0.0);
    require(std::isfinite(reading->sigma_gap_rad) && reading->sigma_gap_rad >= 0.0);
    if (last_) require(reading->stamp > last_->stamp && reading->sequence == last_->sequence + 1);
    last_ = reading;
  }

  CanLayout layout_;
  CanOdometer odometer_;
  CanBus bus_;
  DeviceClock::time_point at_{std::chrono::hours(1)};
  std::optional<OdometryReading> last_;
};

CanLayout float_layout() {
  CanLayout layout = test::speeds_layout();
  layout.odometry = CanOdometryKind::ticks;
  layout.motion[0].signal = {test::kLeftId, {0, 32, CanByteOrder::intel}, CanNumber::ieee_float};
  layout.motion[1].signal = {test::kLeftId, {32, 32, CanByteOrder::intel}, CanNumber::ieee_float};
  return layout;
}

void play(std::uint8_t kind, Bytes script) {
  switch (kind % 4) {
    case 0:
      return Script(test::ticks_layout(test::kRightId, 8 + kind / 8)).play(script);
    case 1:
      return Script(test::speeds_layout()).play(script);
    case 2:
      return Script(test::pose_layout()).play(script);
    default:
      return Script(float_layout()).play(script);
  }
}

}  // namespace
}  // namespace azimuth

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 5) return 0;
  const azimuth::Bytes bytes(data, size);
  for (const std::size_t length : {std::size_t{16}, std::size_t{72}, size - 5}) {
    const auto frame = azimuth::decode_can_frame(bytes.subspan(5).first(std::min(length, size - 5)));
    if (!frame) continue;
    azimuth::check_frame(*frame);
    azimuth::check_signal(bytes.subspan(1, 4), *frame);
  }
  azimuth::play(data[0], bytes.subspan(1));
  return 0;
}
