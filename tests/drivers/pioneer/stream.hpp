#pragma once
// Byte streams for the tests of the Pioneer driver.

#include <cstdint>
#include <initializer_list>
#include <vector>

#include "drivers/pioneer/packet.hpp"

namespace azimuth::pioneer::test {

using ByteVector = std::vector<std::uint8_t>;

inline ByteVector to_vector(ByteView bytes) { return {bytes.begin(), bytes.end()}; }

inline void append(ByteVector& stream, ByteView bytes) { stream.insert(stream.end(), bytes.begin(), bytes.end()); }

/// The data inside the frame.
inline ByteVector data_of(const Frame& frame) {
  return to_vector(frame.view().subspan(3, frame.size - kFrameOverhead));
}

/// The data of all packets that the scanner finds in the stream, fed in pieces of `piece` bytes.
inline std::vector<ByteVector> scan(PacketScanner& scanner, ByteView stream, std::size_t piece = 64) {
  std::vector<ByteVector> found;
  while (!stream.empty()) {
    const std::size_t taken = scanner.add(stream.first(std::min(piece, stream.size())), {});
    stream = stream.subspan(taken);
    while (const auto packet = scanner.next()) found.push_back(to_vector(packet->data));
  }
  return found;
}

}  // namespace azimuth::pioneer::test
