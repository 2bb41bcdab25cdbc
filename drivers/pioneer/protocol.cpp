#include "drivers/pioneer/protocol.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdlib>

namespace azimuth::pioneer {
namespace {

constexpr std::array kBauds{9600, 19200, 38400, 57600, 115200};  // indexed by code

std::optional<int> integer_argument(ByteView argument) {
  if (argument.size() < 3) return std::nullopt;
  const int magnitude = argument[1] | (argument[2] << 8);
  switch (static_cast<ArgumentType>(argument[0])) {
    case ArgumentType::positive:
      return magnitude;
    case ArgumentType::negative:
      return -magnitude;
    default:
      return std::nullopt;
  }
}

std::optional<std::string_view> text_argument(ByteView argument) {
  if (argument.size() < 2 || argument[0] != static_cast<std::uint8_t>(ArgumentType::text)) return std::nullopt;
  const std::size_t length = argument[1];
  if (argument.size() < 2 + length) return std::nullopt;
  return std::string_view(reinterpret_cast<const char*>(argument.data() + 2), length);
}

}  // namespace

Frame encode_command(std::uint8_t number) { return encode_frame(std::array{number}); }

Frame encode_command(std::uint8_t number, int argument) {
  assert(std::abs(argument) <= 32767);
  const auto type = argument < 0 ? ArgumentType::negative : ArgumentType::positive;
  const auto magnitude = static_cast<unsigned>(std::abs(argument));
  return encode_frame(std::array{number, static_cast<std::uint8_t>(type), static_cast<std::uint8_t>(magnitude),
                                 static_cast<std::uint8_t>(magnitude >> 8U)});
}

Frame encode_command(std::uint8_t number, std::string_view argument) {
  assert(argument.size() <= kMaxArgumentText);
  std::array<std::uint8_t, 3 + kMaxArgumentText> data{number, static_cast<std::uint8_t>(ArgumentType::text),
                                                      static_cast<std::uint8_t>(argument.size())};
  std::ranges::transform(argument, data.begin() + 3, [](char c) { return static_cast<std::uint8_t>(c); });
  return encode_frame(ByteView(data).first(3 + argument.size()));
}

DecodedCommand decode_command(ByteView data) {
  assert(!data.empty());
  const ByteView argument = data.subspan(1);
  return {data[0], integer_argument(argument), text_argument(argument), argument};
}

std::optional<int> baud_code(int baud) {
  const auto found = std::ranges::find(kBauds, baud);
  if (found == kBauds.end()) return std::nullopt;
  return static_cast<int>(found - kBauds.begin());
}

std::optional<int> baud_of_code(int code) {
  if (code < 0 || code >= static_cast<int>(kBauds.size())) return std::nullopt;
  return kBauds[static_cast<std::size_t>(code)];
}

}  // namespace azimuth::pioneer
