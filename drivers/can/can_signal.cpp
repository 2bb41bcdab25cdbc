#include "drivers/can/can_signal.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <fmt/format.h>

namespace azimuth {
namespace {

constexpr int kLongestField_bits = 64;

constexpr std::uint64_t low_bits(int count) {
  return count >= kLongestField_bits ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1;
}

std::int64_t sign_extended(std::uint64_t raw, int length_bits) {
  const int unused = kLongestField_bits - length_bits;
  return static_cast<std::int64_t>(raw << unused) >> unused;
}

/// The part of a bit field within one byte.
struct Piece {
  std::size_t byte = 0;
  int lowest_bit = 0;  // within the byte
  int count_bits = 0;
  int shift = 0;  // position of these bits in the number
};

/// Calls `visit` with each piece of the field, in the order of the bytes.
template <class Visit>
void for_each_piece(const CanBits& bits, Visit visit) {
  const bool intel = bits.byte_order == CanByteOrder::intel;
  auto byte = static_cast<std::size_t>(bits.start_bit / 8);
  int in_byte = bits.start_bit % 8;
  for (int left = bits.length_bits; left > 0; ++byte) {
    const int count = std::min(left, intel ? 8 - in_byte : in_byte + 1);
    left -= count;
    visit(Piece{byte, intel ? in_byte : in_byte + 1 - count, count, intel ? bits.length_bits - left - count : left});
    in_byte = intel ? 0 : 7;
  }
}

double number_of(const CanSignal& signal, std::uint64_t raw) {
  switch (signal.number) {
    case CanNumber::unsigned_integer:
      return static_cast<double>(raw);
    case CanNumber::signed_integer:
      return static_cast<double>(sign_extended(raw, signal.bits.length_bits));
    case CanNumber::ieee_float:
      if (signal.bits.length_bits == 32) return std::bit_cast<float>(static_cast<std::uint32_t>(raw));
      return std::bit_cast<double>(raw);
  }
  return 0.0;
}

std::uint64_t raw_of(const CanSignal& signal, double number) {
  switch (signal.number) {
    case CanNumber::unsigned_integer:
      return static_cast<std::uint64_t>(std::round(number));
    case CanNumber::signed_integer:
      return static_cast<std::uint64_t>(std::llround(number)) & low_bits(signal.bits.length_bits);
    case CanNumber::ieee_float:
      if (signal.bits.length_bits == 32) return std::bit_cast<std::uint32_t>(static_cast<float>(number));
      return std::bit_cast<std::uint64_t>(number);
  }
  return 0;
}

bool fits(const CanBits& bits) {
  return bits.start_bit >= 0 && bits.length_bits >= 1 && bits.length_bits <= kLongestField_bits &&
         bits.start_bit < 8 * static_cast<int>(CanFrame::kMostBytes) &&
         bytes_needed(bits) <= static_cast<int>(CanFrame::kMostBytes);
}

}  // namespace

int bytes_needed(const CanBits& bits) {
  const int first = bits.start_bit / 8;
  const int in_first = bits.byte_order == CanByteOrder::intel ? 8 - bits.start_bit % 8 : bits.start_bit % 8 + 1;
  return first + 1 + (std::max(0, bits.length_bits - in_first) + 7) / 8;
}

std::optional<std::uint64_t> read_bits(const CanBits& bits, std::span<const std::uint8_t> bytes) {
  if (bytes_needed(bits) > static_cast<int>(bytes.size())) return std::nullopt;
  std::uint64_t number = 0;
  for_each_piece(bits, [&](const Piece& piece) {
    const std::uint64_t part = (std::uint64_t{bytes[piece.byte]} >> piece.lowest_bit) & low_bits(piece.count_bits);
    number |= part << piece.shift;
  });
  return number;
}

void write_bits(const CanBits& bits, std::uint64_t number, std::span<std::uint8_t> bytes) {
  assert(bytes_needed(bits) <= static_cast<int>(bytes.size()));
  for_each_piece(bits, [&](const Piece& piece) {
    const std::uint64_t mask = low_bits(piece.count_bits);
    const std::uint64_t part = (number >> piece.shift) & mask;
    bytes[piece.byte] =
        static_cast<std::uint8_t>((bytes[piece.byte] & ~(mask << piece.lowest_bit)) | (part << piece.lowest_bit));
  });
}

CanDecoded decode(const CanSignal& signal, const CanFrame& frame) {
  if (frame.kind != CanFrame::Kind::data || frame.id != signal.frame) return {};
  if (signal.multiplexer) {
    const auto selected = read_bits(signal.multiplexer->selector, frame.bytes());
    if (!selected) return {CanFound::too_short, {}};
    if (*selected != signal.multiplexer->value) return {};
  }
  const auto raw = read_bits(signal.bits, frame.bytes());
  if (!raw) return {CanFound::too_short, {}};
  const double value = signal.scale * number_of(signal, *raw) + signal.offset;
  if (!std::isfinite(value)) return {CanFound::not_finite, {}};
  return {CanFound::value, {*raw, value}};
}

void encode(const CanSignal& signal, double value, CanFrame& frame) {
  const std::span<std::uint8_t> bytes(frame.data.data(), frame.size);
  if (signal.multiplexer) write_bits(signal.multiplexer->selector, signal.multiplexer->value, bytes);
  write_bits(signal.bits, raw_of(signal, (value - signal.offset) / signal.scale), bytes);
}

double difference(const CanSignal& signal, const CanValue& newer, const CanValue& older) {
  if (signal.number == CanNumber::ieee_float) return newer.value - older.value;
  const int length_bits = signal.bits.length_bits;
  return signal.scale * static_cast<double>(sign_extended(newer.raw - older.raw, length_bits));
}

std::optional<std::string> problem_of(const CanSignal& signal) {
  if (signal.frame.number > largest_can_id(signal.frame.extended))
    return fmt::format("id {:#x} is larger than {:#x}{}", signal.frame.number, largest_can_id(signal.frame.extended),
                       signal.frame.extended ? "" : ": is the frame an extended one?");
  if (!fits(signal.bits))
    return fmt::format("bits {}|{} are not within {} bytes", signal.bits.start_bit, signal.bits.length_bits,
                       CanFrame::kMostBytes);
  if (signal.multiplexer && !fits(signal.multiplexer->selector)) return "its multiplexer is not within a frame";
  if (signal.number == CanNumber::ieee_float && signal.bits.length_bits != 32 && signal.bits.length_bits != 64)
    return fmt::format("a float has 32 or 64 bits, not {}", signal.bits.length_bits);
  if (!std::isfinite(signal.scale) || signal.scale == 0.0 || !std::isfinite(signal.offset))
    return "scale must be finite and not 0, offset finite";
  return std::nullopt;
}

}  // namespace azimuth
