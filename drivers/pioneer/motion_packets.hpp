#pragma once
// The packets that the robot sends on request in addition to the standard SIP: wheel ticks and the analog gyro.

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/pioneer/packet.hpp"

namespace azimuth::pioneer {

/// ENCODERpac: cumulative ticks of the wheels, modulo 2^32. The firmware's gyro correction does not affect them.
struct EncoderPacket {
  std::int32_t left_ticks = 0, right_ticks = 0;
  friend bool operator==(const EncoderPacket&, const EncoderPacket&) = default;
};

/// GYROpac: the rates of one cycle, one sample every kGyroSamplePeriod_s. It comes before the SIP of its cycle.
struct GyroPacket {
  struct Sample {
    std::uint16_t rate = 0;  ///< 0 to 1023, about 512 at rest, larger when turning clockwise
    std::uint8_t temperature = 0;
    friend bool operator==(const Sample&, const Sample&) = default;
  };
  static constexpr std::size_t kMaxSamples = (kMaxDataSize - 2) / 3;
  std::uint8_t count = 0;
  std::array<Sample, kMaxSamples> samples{};
  std::span<const Sample> all() const { return {samples.data(), count}; }
  friend bool operator==(const GyroPacket&, const GyroPacket&) = default;
};
inline constexpr double kGyroSamplePeriod_s = 0.025;

/// None when `data` is another packet or truncated. A truncated GYROpac gives its complete samples.
std::optional<EncoderPacket> decode_encoder(ByteView data);
std::optional<GyroPacket> decode_gyro(ByteView data);

Frame encode_encoder(const EncoderPacket& encoder);
Frame encode_gyro(const GyroPacket& gyro);

}  // namespace azimuth::pioneer
