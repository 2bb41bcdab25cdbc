#pragma once
// Numbers as bytes, little-endian on every machine, doubles bit for bit, and their checksum. Internal to
// drivers/storage.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>
#include <zlib.h>

#include "base/bytes.hpp"

namespace azimuth {

/// Writes numbers into storage of a size known in advance.
class ByteWriter {
 public:
  ByteWriter(std::vector<std::byte>& out, std::size_t size) : out_(out) {
    out_.clear();
    out_.resize(size);
  }

  void bytes(const void* data, std::size_t size) {
    std::memcpy(out_.data() + at_, data, size);
    at_ += size;
  }
  template <class Integer>
  requires std::is_integral_v<Integer>
  void put(Integer value) {
    auto rest = static_cast<std::make_unsigned_t<Integer>>(value);
    for (std::size_t i = 0; i < sizeof(Integer); ++i) out_[at_++] = static_cast<std::byte>(rest >> (8 * i) & 0xffU);
  }
  void put(double value) { put(std::bit_cast<std::uint64_t>(value)); }
  std::size_t size() const { return at_; }

 private:
  std::vector<std::byte>& out_;
  std::size_t at_ = 0;
};

/// Reads numbers. The caller has checked that the bytes are long enough.
class ByteReader {
 public:
  explicit ByteReader(Bytes bytes) : bytes_(bytes) {}

  void bytes(void* into, std::size_t size) {
    std::memcpy(into, bytes_.data() + at_, size);
    at_ += size;
  }
  template <class Integer>
  requires std::is_integral_v<Integer> Integer get() {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(Integer); ++i) value |= std::to_integer<std::uint64_t>(bytes_[at_++]) << (8 * i);
    return static_cast<Integer>(value);
  }
  double number() { return std::bit_cast<double>(get<std::uint64_t>()); }

 private:
  Bytes bytes_;
  std::size_t at_ = 0;
};

/// CRC-32 as computed by zlib.
inline std::uint32_t checksum(Bytes bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace azimuth
