#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "drivers/can/can_frame.hpp"

namespace azimuth {

/// The order of a number's bits across bytes. Bit 0 is the lowest bit of byte 0, bit 8 the lowest of byte 1, as in DBC
/// files.
enum class CanByteOrder {
  intel,    ///< least significant byte first; start_bit is the lowest bit of the field
  motorola  ///< most significant byte first; start_bit is the highest bit of the field
};

/// A field of bits in a frame.
struct CanBits {
  int start_bit = 0;
  int length_bits = 1;
  CanByteOrder byte_order = CanByteOrder::intel;
  friend bool operator==(const CanBits&, const CanBits&) = default;
};

/// The number format of a signal.
enum class CanNumber {
  unsigned_integer,
  signed_integer,  ///< two's complement
  ieee_float       ///< a float of 32 or 64 bits
};

/// The position of a value in a frame, and its conversion: `scale` times the number, plus `offset`.
struct CanSignal {
  CanId frame;
  CanBits bits;
  CanNumber number = CanNumber::unsigned_integer;
  double scale = 1.0;
  double offset = 0.0;

  /// The signal is present only in frames whose `selector` holds `value`.
  struct Multiplexer {
    CanBits selector;
    std::uint64_t value = 0;
    friend bool operator==(const Multiplexer&, const Multiplexer&) = default;
  };
  std::optional<Multiplexer> multiplexer{};
  friend bool operator==(const CanSignal&, const CanSignal&) = default;
};

/// The value of a signal in a frame.
struct CanValue {
  std::uint64_t raw = 0;  ///< the bits as an unsigned number
  double value = 0.0;     ///< scaled; finite
};

/// The result of reading a signal from a frame.
enum class CanFound {
  value,
  elsewhere,  ///< another frame, or the multiplexer selects other signals
  too_short,
  not_finite
};
struct CanDecoded {
  CanFound found = CanFound::elsewhere;
  CanValue value;  ///< valid when found
};

/// Reads a signal. Remote and error frames have no signals. Reentrant; never allocates.
CanDecoded decode(const CanSignal& signal, const CanFrame& frame);

/// Writes the number nearest to `value`, which must be in the signal's range, and the multiplexer's value. The frame
/// must be long enough.
void encode(const CanSignal& signal, double value, CanFrame& frame);

/// The change of a signal from `older` to `newer`, in its scaled unit. For an integer it is the shortest change modulo
/// its bits, so that a counter may wrap.
double difference(const CanSignal& signal, const CanValue& newer, const CanValue& older);

/// The bits as an unsigned number; none when `bytes` is too short.
std::optional<std::uint64_t> read_bits(const CanBits& bits, std::span<const std::uint8_t> bytes);
/// Writes the bits; `bytes` must be long enough.
void write_bits(const CanBits& bits, std::uint64_t number, std::span<std::uint8_t> bytes);

/// Smallest number of bytes that contains all the bits.
int bytes_needed(const CanBits& bits);
/// What is wrong with a signal regardless of the frame's data, for a person; none when it is correct.
std::optional<std::string> problem_of(const CanSignal& signal);

}  // namespace azimuth
