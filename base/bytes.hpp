#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace azimuth {

using Bytes = std::span<const std::byte>;

/// A view of `bytes` as characters.
inline std::string_view as_text(Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

/// The little-endian number at the start of `bytes`. Missing bytes count as zero.
template <class Integer>
Integer little_endian(Bytes bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(Integer) && i < bytes.size(); ++i)
    value |= std::to_integer<std::uint64_t>(bytes[i]) << (8 * i);
  return static_cast<Integer>(value);
}

/// A growing byte sequence. Thread contract: thread-bound.
class LittleBytes {
 public:
  template <class Integer>
  requires std::is_integral_v<Integer> LittleBytes& put(Integer value) {
    auto rest = static_cast<std::make_unsigned_t<Integer>>(value);
    for (std::size_t i = 0; i < sizeof(Integer); ++i) {
      bytes_ += static_cast<char>(rest & 0xffU);
      if constexpr (sizeof(Integer) > 1) rest = static_cast<std::make_unsigned_t<Integer>>(rest >> 8U);
    }
    return *this;
  }
  LittleBytes& put(float value) { return put(std::bit_cast<std::uint32_t>(value)); }
  LittleBytes& put(double value) { return put(std::bit_cast<std::uint64_t>(value)); }
  /// Appends the bytes without their number in front.
  LittleBytes& raw(std::string_view bytes) {
    bytes_ += bytes;
    return *this;
  }
  /// Appends the number of bytes in 32 bits, then the bytes.
  LittleBytes& text(std::string_view bytes) { return put(static_cast<std::uint32_t>(bytes.size())).raw(bytes); }

  std::size_t size() const { return bytes_.size(); }
  const std::string& bytes() const { return bytes_; }
  std::string take() { return std::exchange(bytes_, {}); }

 private:
  std::string bytes_;
};

}  // namespace azimuth
