// Arbitrary messages of a camera link. An accepted message must encode to the same bytes.

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "drivers/camera/link_messages.hpp"

namespace {

using namespace azimuth::camera_link;

/// Does not apply to bearing sets, whose azimuths are wrapped.
void require_same(azimuth::Bytes message, const std::vector<std::byte>& again) {
  if (!std::ranges::equal(message, again)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const azimuth::Bytes message = std::as_bytes(std::span(data, size));
  static const Hello kHello{azimuth::packed_format(azimuth::PixelFormat::gray8, 64, 48), 4096, 4};
  std::vector<std::byte> again;
  azimuth::BearingSet set;
  if (const auto hello = decode_hello(message)) {
    if (!is_valid(*hello)) std::abort();
    encode(*hello, again);
    require_same(message, again);
  }
  if (const auto frame = decode_frame(message, kHello)) {
    if (frame->slot >= kHello.slots || frame->bytes > kHello.slot_bytes) std::abort();
    encode(*frame, again);
    require_same(message, again);
  }
  if (const auto release = decode_release(message)) {
    encode(*release, again);
    require_same(message, again);
  }
  if (decode_bearings(message, set) && set.bearings.size() > kMaxBearings) std::abort();
  return 0;
}
