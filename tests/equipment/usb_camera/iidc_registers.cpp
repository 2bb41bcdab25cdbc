#include "tests/equipment/usb_camera/iidc_registers.hpp"

#include <algorithm>
#include <cmath>

namespace azimuth::sim {
namespace {

constexpr std::uint32_t kRom = 0xf0000400, kBase = 0xf0f00000;

// Inquiry registers: the available formats, modes, rates and features. The most significant bit is the first of each.
constexpr std::uint32_t kFormats = 0x100, kModesOfFormat0 = 0x180, kRatesOfFormat0 = 0x200, kBasicFunctions = 0x400,
                        kFeatures = 0x404, kFeatureInquiries = 0x500, kFeatureValues = 0x800;
constexpr std::uint32_t kPower = 0x610, kIsoChannel = 0x60c;
constexpr std::uint32_t kFirstRate = 2, kLastRate = 4;  // 7.5, 15 and 30 Hz
constexpr std::uint32_t kFirstBit = 1U << 31U;

// Bits of a feature's inquiry and value registers.
constexpr std::uint32_t kPresent = 1U << 31U, kReadable = 1U << 27U, kSwitchable = 1U << 26U, kCanAutomatic = 1U << 25U,
                        kCanManual = 1U << 24U, kOn = 1U << 25U;
constexpr std::uint32_t kFeatureMaximum = 1023, kFeatureInitial = 256;
constexpr std::uint32_t kValueMask = 0xfff;

struct IidcFeature {
  std::uint32_t offset;
  bool two_values;  // White balance has one value for blue and one for red
};
constexpr std::array kKnownFeatures{IidcFeature{iidc::kBrightness, false},  IidcFeature{iidc::kExposure, false},
                                    IidcFeature{iidc::kWhiteBalance, true}, IidcFeature{iidc::kShutter, false},
                                    IidcFeature{iidc::kGain, false},        IidcFeature{iidc::kFocus, false}};

constexpr std::uint32_t entry(std::uint32_t key, std::uint32_t value) { return key << 24U | value; }
constexpr std::uint32_t directory(std::uint32_t quadlets) { return quadlets << 16U; }

constexpr std::uint32_t letters(const char (&text)[5]) {
  std::uint32_t quadlet = 0;
  for (int i = 0; i < 4; ++i) quadlet = quadlet << 8U | static_cast<std::uint8_t>(text[i]);
  return quadlet;
}

}  // namespace

/// The entries of a directory that refer to other places count quadlets from their own position.
IidcRegisters::IidcRegisters(std::uint64_t guid) {
  constexpr std::uint32_t kVendor = 0x00b09d, kIidcSpecification = 0x00a02d, kIidcVersion = 0x000102;
  constexpr std::uint32_t kBaseQuadlets = (kBase - 0xf0000000) / 4;
  const std::array rom{// Bus information block, with the GUID
                       0x04040000U, letters("1394"), 0xf000a002U, static_cast<std::uint32_t>(guid >> 32U),
                       static_cast<std::uint32_t>(guid),
                       // Root directory: vendor, capabilities and, after it, the unit directory
                       directory(3), entry(0x03, kVendor), entry(0x0c, 0x0083c0), entry(0xd1, 1),
                       // Unit directory: an IIDC camera and, after it, the unit-dependent directory
                       directory(3), entry(0x12, kIidcSpecification), entry(0x13, kIidcVersion), entry(0xd4, 1),
                       // Unit-dependent directory: register base, vendor name, model name, version 1.31 of the
                       // specification
                       directory(4), entry(0x40, kBaseQuadlets), entry(0x81, 3), entry(0x82, 8), entry(0x38, 0x000010),
                       // "Azimuth"
                       directory(5), 0U, 0U, letters("Azim"), letters("uth\0"), 0U,
                       // "VCAM-1"
                       directory(4), 0U, 0U, letters("VCAM"), letters("-1\0\0")};
  static_assert(rom.size() <= kRomQuadlets);
  std::ranges::copy(rom, rom_.begin());
  reset();
}

void IidcRegisters::reset() {
  registers_.fill(0);
  at(kFormats) = kFirstBit;
  at(kModesOfFormat0) = kFirstBit >> iidc::kModeYuv422_320x240 | kFirstBit >> iidc::kModeMono8_640x480;
  for (const std::uint32_t mode : {iidc::kModeYuv422_320x240, iidc::kModeMono8_640x480}) {
    for (std::uint32_t rate = kFirstRate; rate <= kLastRate; ++rate) {
      at(kRatesOfFormat0 + 4 * mode) |= kFirstBit >> rate;
    }
  }
  at(kBasicFunctions) = kFirstBit | 1U << 15U;  // The camera can be switched off
  for (const auto& [offset, two_values] : kKnownFeatures) {
    const std::uint32_t number = (offset - kFeatureValues) / 4;
    at(kFeatures) |= kFirstBit >> number;
    at(kFeatureInquiries + 4 * number) =
        kPresent | kReadable | kSwitchable | kCanAutomatic | kCanManual | kFeatureMaximum;
    at(offset) = kPresent | kOn | iidc::kFeatureAutomatic | kFeatureInitial | (two_values ? kFeatureInitial << 12U : 0);
  }
  at(iidc::kRate) = 3U << 29U;
  at(iidc::kMode) = iidc::kModeMono8_640x480 << 29U;
  at(kIsoChannel) = 2U << 24U;
  at(kPower) = kFirstBit;
}

std::optional<std::uint32_t> IidcRegisters::read(std::uint32_t address) const {
  if (address % 4 != 0) return std::nullopt;
  if (address >= kRom && address - kRom < 4 * kRomQuadlets) return rom_[(address - kRom) / 4];
  if (address >= kBase && address - kBase < kRegisterBytes) return at(address - kBase);
  return std::nullopt;
}

bool IidcRegisters::write(std::uint32_t address, std::uint32_t value) {
  if (address % 4 != 0 || address < kBase || address - kBase >= kRegisterBytes) return false;
  const std::uint32_t offset = address - kBase;
  if (offset == iidc::kInitialize) {
    if ((value & kFirstBit) != 0) reset();
  } else if (offset == iidc::kMode) {
    const std::uint32_t mode = value >> 29U;
    if (mode != iidc::kModeYuv422_320x240 && mode != iidc::kModeMono8_640x480) return false;
    at(offset) = value;
  } else if (offset == iidc::kRate) {
    if (value >> 29U < kFirstRate || value >> 29U > kLastRate) return false;
    at(offset) = value;
  } else if (offset >= kFeatureValues) {
    write_feature(offset, value);
  } else if (offset >= 0x600) {  // Writes to inquiry registers are ignored
    at(offset) = value;
  }
  return true;
}

/// Values outside the range are clamped, as by real cameras.
void IidcRegisters::write_feature(std::uint32_t offset, std::uint32_t value) {
  const auto known = std::ranges::find(kKnownFeatures, offset, &IidcFeature::offset);
  if (known == kKnownFeatures.end()) return;
  const auto limited = [&](unsigned shift) { return std::min(value >> shift & kValueMask, kFeatureMaximum) << shift; };
  at(offset) =
      kPresent | (value & (kOn | iidc::kFeatureAutomatic)) | limited(0) | (known->two_values ? limited(12) : 0);
}

std::uint32_t IidcRegisters::mode() const { return at(iidc::kMode) >> 29U; }
double IidcRegisters::rate_hz() const { return 1.875 * std::exp2(at(iidc::kRate) >> 29U); }
bool IidcRegisters::streaming() const { return (at(iidc::kStreaming) & kFirstBit) != 0; }

}  // namespace azimuth::sim
