#pragma once
// Internal to drivers/pioneer: the fields inside a packet's data, little-endian, one after the other.

#include <algorithm>
#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "drivers/pioneer/packet.hpp"

namespace azimuth::pioneer {

/// Reads fields until the bytes end. An incomplete field keeps its value and ends the reading.
class FieldReader {
 public:
  explicit FieldReader(ByteView bytes) : rest_(bytes) {}

  template <std::integral Field>
  bool read(Field& field) {
    if (!take(sizeof field)) return false;
    std::uint64_t value = 0;
    for (std::size_t i = sizeof field; i > 0; --i) value = (value << 8U) | taken_[i - 1];
    field = static_cast<Field>(value);
    return true;
  }
  /// A field that may be missing; it then has no value.
  template <std::integral Field>
  bool read(std::optional<Field>& field) {
    Field value{};
    if (!read(value)) return false;
    field = value;
    return true;
  }
  /// Reads text up to a NUL byte, which must be present.
  bool read(std::string& field) {
    const auto nul = std::ranges::find(rest_, 0);
    if (nul == rest_.end() || !take(static_cast<std::size_t>(nul - rest_.begin()) + 1)) return end();
    field.assign(taken_.begin(), taken_.end() - 1);
    return true;
  }

 private:
  bool take(std::size_t count) {
    if (rest_.size() < count) return end();
    taken_ = rest_.first(count);
    rest_ = rest_.subspan(count);
    return true;
  }
  bool end() {
    rest_ = {};
    return false;
  }
  ByteView rest_, taken_;
};

/// Writes fields into one packet. Once a field does not fit, or an optional one is missing, it returns false and writes
/// nothing more.
class FieldWriter {
 public:
  explicit FieldWriter(std::uint8_t id) { write(id); }

  template <std::integral Field>
  bool write(Field field) {
    if (ended_ || size_ + sizeof field > kMaxDataSize) return end();
    std::uint64_t value = static_cast<std::make_unsigned_t<Field>>(field);
    for (std::size_t i = 0; i < sizeof field; ++i, value >>= 8U) data_[size_++] = static_cast<std::uint8_t>(value);
    return true;
  }
  template <std::integral Field>
  bool write(const std::optional<Field>& field) {
    return field ? write(*field) : end();
  }
  bool write(const std::string& field) {
    if (ended_ || size_ + field.size() + 1 > kMaxDataSize) return end();
    for (const char c : field) data_[size_++] = static_cast<std::uint8_t>(c);
    data_[size_++] = 0;
    return true;
  }
  Frame frame() const { return encode_frame(ByteView(data_).first(size_)); }

 private:
  bool end() {
    ended_ = true;
    return false;
  }
  std::array<std::uint8_t, kMaxDataSize> data_{};
  std::size_t size_ = 0;
  bool ended_ = false;
};

}  // namespace azimuth::pioneer
