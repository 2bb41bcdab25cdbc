#include "drivers/camera/link_messages.hpp"

#include <bit>
#include <cassert>
#include <concepts>

#include "drivers/wire/plausible.hpp"

namespace azimuth::camera_link {

namespace {

constexpr std::uint32_t kMagic = 0x4D435A41;  // "AZCM"
constexpr std::size_t kBearingsHeader = 24, kBearingBytes = 52;
static_assert(kMaxMessageBytes == kBearingsHeader + kMaxBearings * kBearingBytes);

class Writer {
 public:
  Writer(MessageKind kind, std::vector<std::byte>& out) : out_(out) {
    out_.clear();
    put(static_cast<std::uint32_t>(kind));
  }

  template <std::unsigned_integral Word>
  void put(Word word) {
    for (unsigned shift = 0; shift < 8 * sizeof word; shift += 8) {
      out_.push_back(static_cast<std::byte>((word >> shift) & 0xFFU));
    }
  }
  void put(int value) { put(static_cast<std::uint32_t>(value)); }
  void put(std::int64_t value) { put(static_cast<std::uint64_t>(value)); }
  void put(double value) { put(std::bit_cast<std::uint64_t>(value)); }

 private:
  std::vector<std::byte>& out_;
};

/// Reads past the end return zero and are recorded.
class MessageReader {
 public:
  explicit MessageReader(Bytes message) : rest_(message) {}

  template <std::unsigned_integral Word>
  Word get() {
    if (rest_.size() < sizeof(Word)) {
      too_short_ = true;
      return 0;
    }
    Word word = 0;
    for (std::size_t i = sizeof word; i-- > 0;) word = (word << 8U) | std::to_integer<Word>(rest_[i]);
    rest_ = rest_.subspan(sizeof word);
    return word;
  }
  std::uint32_t get32() { return get<std::uint32_t>(); }
  std::uint64_t get64() { return get<std::uint64_t>(); }
  std::int64_t get_signed() { return static_cast<std::int64_t>(get64()); }
  double get_double() { return std::bit_cast<double>(get64()); }

  bool is(MessageKind kind) { return get32() == static_cast<std::uint32_t>(kind); }
  bool ended_well() const { return !too_short_ && rest_.empty(); }

 private:
  Bytes rest_;
  bool too_short_ = false;
};

/// Returns -1 for a value that is too large for the side of an image, so that is_valid() refuses it.
int get_small(MessageReader& reader) {
  const std::uint32_t value = reader.get32();
  return value <= 0xFFFFFF ? static_cast<int>(value) : -1;
}

}  // namespace

bool is_valid(const Hello& hello) {
  if (hello.slots == 0) return hello == Hello{};
  if (hello.slots > FramePool::kMaxSlots || hello.slot_bytes > kMaxSlotBytes) return false;
  if (!azimuth::is_valid(hello.format) || hello.slot_bytes == 0) return false;
  return hello.format.bytes() <= hello.slot_bytes && hello.memory_bytes() <= kMaxMemory;
}

void encode(const Hello& hello, std::vector<std::byte>& out) {
  Writer writer(MessageKind::hello, out);
  writer.put(kMagic);
  writer.put(kLayout);
  writer.put(static_cast<std::uint32_t>(hello.format.pixels));
  writer.put(hello.format.width_px);
  writer.put(hello.format.height_px);
  writer.put(hello.format.stride_bytes);
  writer.put(hello.slot_bytes);
  writer.put(hello.slots);
}

void encode(const FrameMessage& frame, std::vector<std::byte>& out) {
  Writer writer(MessageKind::frame, out);
  writer.put(frame.slot);
  writer.put(frame.sequence);
  writer.put(to_us(frame.stamp));
  writer.put(frame.bytes);
}

void encode(const BearingSet& set, std::vector<std::byte>& out) {
  assert(set.bearings.size() <= kMaxBearings);
  Writer writer(MessageKind::bearings, out);
  writer.put(static_cast<std::uint32_t>(set.bearings.size()));
  writer.put(set.sequence);
  writer.put(to_us(set.stamp));
  for (const Bearing& bearing : set.bearings) {
    writer.put(bearing.azimuth_rad);
    writer.put(bearing.elevation_rad);
    writer.put(bearing.identity);
    writer.put(bearing.sigma_rad);
    writer.put(bearing.radius_px);
    writer.put(bearing.sigma_elevation_rad);
    writer.put(bearing.kind);
  }
}

void encode(const Release& release, std::vector<std::byte>& out) {
  Writer writer(MessageKind::release, out);
  writer.put(release.slot);
  writer.put(release.sequence);
}

std::optional<MessageKind> kind_of(Bytes message) {
  const std::uint32_t kind = MessageReader(message).get32();
  if (kind < static_cast<std::uint32_t>(MessageKind::hello) || kind > static_cast<std::uint32_t>(MessageKind::release))
    return std::nullopt;
  return static_cast<MessageKind>(kind);
}

std::optional<Hello> decode_hello(Bytes message) {
  MessageReader reader(message);
  if (!reader.is(MessageKind::hello) || reader.get32() != kMagic || reader.get32() != kLayout) return std::nullopt;
  Hello hello;
  const std::uint32_t pixels = reader.get32();
  if (pixels >= kPixelFormats) return std::nullopt;
  hello.format.pixels = static_cast<PixelFormat>(pixels);
  hello.format.width_px = get_small(reader);
  hello.format.height_px = get_small(reader);
  hello.format.stride_bytes = get_small(reader);
  hello.slot_bytes = reader.get32();
  hello.slots = reader.get32();
  if (!reader.ended_well() || !is_valid(hello)) return std::nullopt;
  return hello;
}

std::optional<FrameMessage> decode_frame(Bytes message, const Hello& hello) {
  MessageReader reader(message);
  if (!reader.is(MessageKind::frame)) return std::nullopt;
  FrameMessage frame;
  frame.slot = reader.get32();
  frame.sequence = reader.get64();
  const std::int64_t stamp_us = reader.get_signed();
  frame.stamp = stamp_from_us(stamp_us);
  frame.bytes = reader.get32();
  if (!reader.ended_well() || !is_plausible_stamp(stamp_us) || frame.slot >= hello.slots) return std::nullopt;
  const bool whole = hello.format.pixels == PixelFormat::mjpeg ? frame.bytes > 0 && frame.bytes <= hello.slot_bytes
                                                               : frame.bytes == hello.format.bytes();
  return whole ? std::optional(frame) : std::nullopt;
}

std::optional<Release> decode_release(Bytes message) {
  MessageReader reader(message);
  if (!reader.is(MessageKind::release)) return std::nullopt;
  Release release;
  release.slot = reader.get32();
  release.sequence = reader.get64();
  return reader.ended_well() && release.slot < FramePool::kMaxSlots ? std::optional(release) : std::nullopt;
}

bool decode_bearings(Bytes message, BearingSet& into) {
  MessageReader reader(message);
  if (!reader.is(MessageKind::bearings)) return false;
  const std::size_t count = reader.get32();
  if (count > kMaxBearings || message.size() != kBearingsHeader + count * kBearingBytes) return false;
  into.sequence = reader.get64();
  const std::int64_t stamp_us = reader.get_signed();
  into.stamp = stamp_from_us(stamp_us);
  into.clear();
  for (std::size_t i = 0; i < count; ++i) {
    Bearing bearing;
    bearing.azimuth_rad = reader.get_double();
    bearing.elevation_rad = reader.get_double();
    bearing.identity = reader.get_signed();
    bearing.sigma_rad = reader.get_double();
    bearing.radius_px = reader.get_double();
    bearing.sigma_elevation_rad = reader.get_double();
    bearing.kind = static_cast<Kind>(reader.get32());
    if (!is_plausible(bearing)) return false;
    into.bearings.push_back(bearing);
  }
  return is_plausible_stamp(stamp_us);
}

}  // namespace azimuth::camera_link
