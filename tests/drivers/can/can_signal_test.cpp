// Compares signals with values computed by hand and with a bit-by-bit decoder.

#include "drivers/can/can_signal.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <vector>

namespace azimuth {
namespace {

using Octets = std::vector<std::uint8_t>;

constexpr CanByteOrder kIntel = CanByteOrder::intel, kMotorola = CanByteOrder::motorola;

CanFrame frame_of(const Octets& data, CanId id = {0x123, false}) {
  CanFrame frame;
  frame.id = id;
  frame.fd = data.size() > 8;
  frame.size = static_cast<std::uint8_t>(data.size());
  std::copy(data.begin(), data.end(), frame.data.begin());
  return frame;
}

CanSignal signal_of(CanBits bits, CanNumber number = CanNumber::unsigned_integer, double scale = 1.0,
                    double offset = 0.0) {
  return {{0x123, false}, bits, number, scale, offset};
}

/// Decodes the number bit by bit from its bit positions in the frame. Intel positions increase; Motorola positions
/// decrease within a byte and continue at the highest bit of the next byte.
std::optional<std::uint64_t> slowly(const CanBits& bits, const Octets& bytes) {
  std::vector<bool> from_lowest;
  int place = bits.start_bit;
  for (int i = 0; i < bits.length_bits; ++i) {
    if (place / 8 >= static_cast<int>(bytes.size())) return std::nullopt;
    from_lowest.push_back((bytes[static_cast<std::size_t>(place / 8)] >> (place % 8) & 1) != 0);
    if (bits.byte_order == kIntel) {
      ++place;
    } else {
      place = place % 8 == 0 ? place + 15 : place - 1;
    }
  }
  if (bits.byte_order == kMotorola) std::reverse(from_lowest.begin(), from_lowest.end());
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < from_lowest.size(); ++i) number |= std::uint64_t{from_lowest[i]} << i;
  return number;
}

TEST(CanSignal, ReadsIntelNumbersWorkedOutByHand) {
  EXPECT_EQ(read_bits({0, 16, kIntel}, Octets{0x34, 0x12}), 0x1234U);
  EXPECT_EQ(read_bits({4, 12, kIntel}, Octets{0xAB, 0xCD}), 0xCDAU);
  EXPECT_EQ(read_bits({7, 2, kIntel}, Octets{0x80, 0x00}), 1U);
  EXPECT_EQ(read_bits({7, 2, kIntel}, Octets{0x00, 0x01}), 2U);
  EXPECT_EQ(read_bits({0, 64, kIntel}, Octets{1, 2, 3, 4, 5, 6, 7, 8}), 0x0807060504030201U);
}

TEST(CanSignal, ReadsMotorolaNumbersWorkedOutByHand) {
  // The start bit is the highest bit. 7|16 covers the first two bytes, most significant first.
  EXPECT_EQ(read_bits({7, 16, kMotorola}, Octets{0x12, 0x34}), 0x1234U);
  EXPECT_EQ(read_bits({7, 24, kMotorola}, Octets{0x12, 0x34, 0x56}), 0x123456U);
  // 3|12: the low half of byte 0, then all of byte 1.
  EXPECT_EQ(read_bits({3, 12, kMotorola}, Octets{0xAB, 0xCD}), 0xBCDU);
  // 5|10: bits 5 to 0 of byte 0 (10 1011), then bits 7 to 4 of byte 1 (1100).
  EXPECT_EQ(read_bits({5, 10, kMotorola}, Octets{0xAB, 0xCD}), 0b10'1011'1100U);
  // 0|2: the lowest bit of byte 0, then the highest bit of byte 1.
  EXPECT_EQ(read_bits({0, 2, kMotorola}, Octets{0x01, 0x00}), 2U);
  EXPECT_EQ(read_bits({0, 2, kMotorola}, Octets{0xFE, 0x80}), 1U);
  EXPECT_EQ(read_bits({7, 64, kMotorola}, Octets{1, 2, 3, 4, 5, 6, 7, 8}), 0x0102030405060708U);
}

TEST(CanSignal, ScalesAndExtendsTheSign) {
  const CanFrame frame = frame_of({0xFE, 0xFF, 0x80});
  EXPECT_DOUBLE_EQ(decode(signal_of({0, 16}, CanNumber::signed_integer, 0.5, 10.0), frame).value.value, 9.0);
  EXPECT_DOUBLE_EQ(decode(signal_of({0, 16}, CanNumber::unsigned_integer, 0.5), frame).value.value, 32767.0);
  EXPECT_DOUBLE_EQ(decode(signal_of({23, 1}, CanNumber::signed_integer), frame).value.value, -1.0);
}

TEST(CanSignal, ReadsFloats) {
  // 1.5f is 0x3FC00000, -2.0 is 0xC000000000000000.
  EXPECT_EQ(decode(signal_of({0, 32}, CanNumber::ieee_float, 2.0), frame_of({0, 0, 0xC0, 0x3F})).value.value, 3.0);
  EXPECT_EQ(decode(signal_of({7, 32, kMotorola}, CanNumber::ieee_float), frame_of({0x3F, 0xC0, 0, 0})).value.value,
            1.5);
  EXPECT_EQ(
      decode(signal_of({7, 64, kMotorola}, CanNumber::ieee_float), frame_of({0xC0, 0, 0, 0, 0, 0, 0, 0})).value.value,
      -2.0);
  EXPECT_EQ(decode(signal_of({0, 32}, CanNumber::ieee_float), frame_of({0, 0, 0xC0, 0x7F})).found,
            CanFound::not_finite);
  EXPECT_EQ(decode(signal_of({0, 32}, CanNumber::ieee_float), frame_of({0, 0, 0x80, 0xFF})).found,
            CanFound::not_finite);
}

TEST(CanSignal, IsOnlyInDataFramesOfItsId) {
  const CanSignal signal = signal_of({0, 8});
  EXPECT_EQ(decode(signal, frame_of({1})).found, CanFound::value);
  EXPECT_EQ(decode(signal, frame_of({1}, {0x123, true})).found, CanFound::elsewhere);
  EXPECT_EQ(decode(signal, frame_of({1}, {0x124, false})).found, CanFound::elsewhere);
  CanFrame other = frame_of({1});
  other.kind = CanFrame::Kind::remote;
  EXPECT_EQ(decode(signal, other).found, CanFound::elsewhere);
  other.kind = CanFrame::Kind::error;
  EXPECT_EQ(decode(signal, other).found, CanFound::elsewhere);
}

TEST(CanSignal, IsMissedInEveryFrameThatIsTooShort) {
  const CanSignal intel = signal_of({20, 16}), motorola = signal_of({18, 16, kMotorola});
  for (std::size_t size = 0; size <= 8; ++size) {
    const auto expected = size < 5 ? CanFound::too_short : CanFound::value;
    EXPECT_EQ(decode(intel, frame_of(Octets(size))).found, expected) << size;
    EXPECT_EQ(decode(motorola, frame_of(Octets(size))).found, expected) << size;
  }
  EXPECT_EQ(bytes_needed({504, 8, kIntel}), 64);
  EXPECT_EQ(decode(signal_of({504, 8}), frame_of(Octets(64, 7))).value.value, 7.0);
}

TEST(CanSignal, FollowsItsMultiplexer) {
  CanSignal signal = signal_of({8, 8});
  signal.multiplexer = {{0, 4}, 5};
  EXPECT_EQ(decode(signal, frame_of({0xF5, 42})).value.value, 42.0);
  EXPECT_EQ(decode(signal, frame_of({0xF4, 42})).found, CanFound::elsewhere);
  EXPECT_EQ(decode(signal, frame_of({})).found, CanFound::too_short);
  EXPECT_EQ(decode(signal, frame_of({0xF4})).found, CanFound::elsewhere) << "not wanted in this frame, so not missed";
}

TEST(CanSignal, DifferencesGoTheShortestWayModuloTheBits) {
  const CanSignal counter = signal_of({0, 12}, CanNumber::unsigned_integer, 0.5);
  const auto value = [&](double number) {
    CanFrame frame = frame_of({0, 0});
    encode(counter, number, frame);
    return decode(counter, frame).value;
  };
  EXPECT_DOUBLE_EQ(difference(counter, value(1.0), value(2047.0)), 2.0);
  EXPECT_DOUBLE_EQ(difference(counter, value(2047.0), value(1.0)), -2.0);
  EXPECT_DOUBLE_EQ(difference(counter, value(1000.0), value(0.0)), 1000.0);
}

TEST(CanSignal, ProblemsAreNamed) {
  EXPECT_EQ(problem_of(signal_of({0, 16})), std::nullopt);
  EXPECT_EQ(problem_of(signal_of({0, 64})), std::nullopt);
  EXPECT_TRUE(problem_of(signal_of({0, 65})));
  EXPECT_TRUE(problem_of(signal_of({0, 0})));
  EXPECT_TRUE(problem_of(signal_of({-1, 8})));
  EXPECT_TRUE(problem_of(signal_of({512, 1})));
  EXPECT_TRUE(problem_of(signal_of({505, 8})));
  EXPECT_EQ(problem_of(signal_of({504, 8, kMotorola})), "bits 504|8 are not within 64 bytes");
  EXPECT_TRUE(problem_of(signal_of({0, 16}, CanNumber::ieee_float)));
  EXPECT_TRUE(problem_of(signal_of({0, 16}, CanNumber::unsigned_integer, 0.0)));
  EXPECT_TRUE(problem_of(signal_of({0, 16}, CanNumber::unsigned_integer, NAN)));
  CanSignal standard = signal_of({0, 16});
  standard.frame.number = 0x800;
  EXPECT_TRUE(problem_of(standard));
  standard.frame.extended = true;
  EXPECT_EQ(problem_of(standard), std::nullopt);
}

CanBits any_bits() {
  return {*rc::gen::inRange(0, 512), *rc::gen::inRange(1, 65), *rc::gen::element(kIntel, kMotorola)};
}

RC_GTEST_PROP(CanSignal, BitsAreThoseOfASlowReading, ()) {
  const CanBits bits = any_bits();
  const auto size = *rc::gen::element<std::size_t>(0, 1, 2, 3, 5, 8, 12, 64);
  const auto bytes = *rc::gen::container<Octets>(size, rc::gen::arbitrary<std::uint8_t>());
  RC_ASSERT(read_bits(bits, bytes) == slowly(bits, bytes));
}

RC_GTEST_PROP(CanSignal, WritingChangesItsBitsAndNoOthers, ()) {
  const CanBits bits = any_bits();
  RC_PRE(bytes_needed(bits) <= 64);
  const auto before = *rc::gen::container<Octets>(64, rc::gen::arbitrary<std::uint8_t>());
  const std::uint64_t mask = bits.length_bits == 64 ? ~0ULL : (1ULL << bits.length_bits) - 1;
  const std::uint64_t number = *rc::gen::arbitrary<std::uint64_t>() & mask;
  Octets after = before;
  write_bits(bits, number, after);
  RC_ASSERT(slowly(bits, after) == number);
  write_bits(bits, *slowly(bits, before), after);
  RC_ASSERT(after == before);
}

RC_GTEST_PROP(CanSignal, ValuesAreReadAsTheyWereWritten, ()) {
  CanSignal signal = signal_of(any_bits());
  RC_PRE(bytes_needed(signal.bits) <= 64 && signal.bits.length_bits <= 50);
  const bool has_sign = *rc::gen::arbitrary<bool>();
  signal.number = has_sign ? CanNumber::signed_integer : CanNumber::unsigned_integer;
  signal.scale = *rc::gen::element(1.0, -0.25, 1e-3);
  signal.offset = *rc::gen::element(0.0, -40.0);
  const double range = std::ldexp(1.0, signal.bits.length_bits);
  const double part = *rc::gen::inRange(0, 1'000'000) / 1e6;
  const double number = std::floor(part * range) - (has_sign ? range / 2 : 0.0);
  CanFrame frame = frame_of(Octets(64));
  encode(signal, signal.scale * number + signal.offset, frame);
  const CanDecoded decoded = decode(signal, frame);
  RC_ASSERT(decoded.found == CanFound::value);
  RC_ASSERT(std::abs(decoded.value.value - (signal.scale * number + signal.offset)) <= 1e-6 * std::abs(signal.scale));
}

}  // namespace
}  // namespace azimuth
