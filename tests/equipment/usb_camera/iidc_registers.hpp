#pragma once
#include <array>
#include <cstdint>
#include <optional>

namespace azimuth::sim {

/// Offsets from the camera's command base, by the IIDC specification.
namespace iidc {
inline constexpr std::uint32_t kInitialize = 0x000, kRate = 0x600, kMode = 0x604, kStreaming = 0x614;
inline constexpr std::uint32_t kBrightness = 0x800, kExposure = 0x804, kWhiteBalance = 0x80c, kShutter = 0x81c,
                               kGain = 0x820, kFocus = 0x828;
inline constexpr std::uint32_t kFeatureAutomatic = 1U << 24U;
inline constexpr std::uint32_t kModeYuv422_320x240 = 1, kModeMono8_640x480 = 5;
}  // namespace iidc

/// The configuration ROM and the registers of an emulated IIDC camera: two modes of format 0 (YUV 4:2:2 at 320 x 240
/// and MONO8 at 640 x 480, each at 7.5, 15 and 30 Hz) and six features that store the values written.
///
/// Addresses are the low 32 bits of those on a 1394 bus.
///
/// Thread contract: thread-bound.
class IidcRegisters {
 public:
  explicit IidcRegisters(std::uint64_t guid);

  std::optional<std::uint32_t> read(std::uint32_t address) const;
  /// Returns false if there is no such register or the value is not permitted.
  bool write(std::uint32_t address, std::uint32_t value);

  std::uint32_t mode() const;
  double rate_hz() const;
  bool streaming() const;
  void stop_streaming() { at(iidc::kStreaming) = 0; }
  void reset();

 private:
  static constexpr std::uint32_t kRegisterBytes = 0x1000;
  static constexpr std::size_t kRomQuadlets = 32;

  std::uint32_t& at(std::uint32_t offset) { return registers_[offset / 4]; }
  std::uint32_t at(std::uint32_t offset) const { return registers_[offset / 4]; }
  void write_feature(std::uint32_t offset, std::uint32_t value);

  std::array<std::uint32_t, kRomQuadlets> rom_{};
  std::array<std::uint32_t, kRegisterBytes / 4> registers_{};
};

}  // namespace azimuth::sim
