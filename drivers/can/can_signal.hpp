#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "drivers/can/can_frame.hpp"

namespace azimuth {

/// How the bits of a number follow each other from byte to byte. Bit 0 is the lowest bit of byte 0, bit 8 the lowest of
/// byte 1, as in DBC files.
enum class CanByteOrder {
  intel,    ///< least significant byte first; a field's start is its lowest bit
  motorola  ///< most significant byte first; a field's start is its highest bit
};

/// Some bits of a frame.
struct CanBits {
  int start_bit = 0;
  int length_bits = 1;
  CanByteOrder byte_order = CanByteOrder::intel;
  friend bool operator==(const CanBits&, const CanBits&) = default;
};

/// What the bits of a signal mean.
enum class CanNumber {
  unsigned_integer,
  signed_integer,  ///< two's complement
  ieee_float       ///< of 32 or 64 bits
};

/// Where a value is in which frame, and how it is read: `scale` times the number, plus `offset`.
struct CanSignal {
  CanId frame;
  CanBits bits;
  CanNumber number = CanNumber::unsigned_integer;
  double scale = 1.0;
  double offset = 0.0;

  /// The signal is there only in frames whose `selector` holds `value`.
  struct Multiplexer {
    CanBits selector;
    std::uint64_t value = 0;
    friend bool operator==(const Multiplexer&, const Multiplexer&) = default;
  };
  std::optional<Multiplexer> multiplexer{};
  friend bool operator==(const CanSignal&, const CanSignal&) = default;
};

/// What a signal says in a frame.
struct CanValue {
  std::uint64_t raw = 0;  ///< the bits as they are
  double value = 0.0;     ///< scaled; finite
};

/// Of a frame that should have a signal.
enum class CanFound {
  value,
  elsewhere,  ///< the frame is another's, or the multiplexer says that it has other signals
  too_short,
  not_finite
};
struct CanDecoded {
  CanFound found = CanFound::elsewhere;
  CanValue value;  ///< when found
};

/// Reads a signal. Remote and error frames have none. Reentrant; never allocates.
CanDecoded decode(const CanSignal& signal, const CanFrame& frame);

/// Writes the number nearest to `value`, which must be in the signal's range, and the multiplexer's value. The frame
/// must be long enough.
void encode(const CanSignal& signal, double value, CanFrame& frame);

/// How far a signal went from `older` to `newer`, in its scaled unit: of an integer the shortest way modulo its bits,
/// so that a counter may wrap.
double difference(const CanSignal& signal, const CanValue& newer, const CanValue& older);

/// The bits as an unsigned number; nothing when `bytes` has not all of them.
std::optional<std::uint64_t> read_bits(const CanBits& bits, std::span<const std::uint8_t> bytes);
/// `bytes` must have all of them.
void write_bits(const CanBits& bits, std::uint64_t number, std::span<std::uint8_t> bytes);

/// The least number of bytes that hold all the bits.
int bytes_needed(const CanBits& bits);
/// What is wrong with a signal whatever its frame holds, for a person; nothing when it is right.
std::optional<std::string> problem_of(const CanSignal& signal);

}  // namespace azimuth
