#include "tests/support/png_file.hpp"

#include <algorithm>
#include <span>

namespace azimuth::test {
namespace {

/// CRC-32 as defined by ISO 3309.
std::uint32_t crc(std::span<const std::byte> bytes) {
  std::uint32_t sum = ~0U;
  for (const std::byte each : bytes) {
    sum ^= std::to_integer<std::uint32_t>(each);
    for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1U) ^ ((sum & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  return ~sum;
}

std::uint32_t adler(const std::vector<std::uint8_t>& bytes) {
  std::uint32_t a = 1, b = 0;
  for (const std::uint8_t each : bytes) {
    a = (a + each) % 65521U;
    b = (b + a) % 65521U;
  }
  return (b << 16U) | a;
}

std::uint8_t part(std::size_t value, unsigned shift) { return static_cast<std::uint8_t>((value >> shift) & 0xFFU); }

/// A zlib stream of uncompressed blocks.
std::vector<std::uint8_t> stored(const std::vector<std::uint8_t>& bytes) {
  constexpr std::size_t kMostOfABlock = 65535;
  std::vector<std::uint8_t> out{0x78, 0x01};
  std::size_t at = 0;
  do {
    const std::size_t length = std::min(kMostOfABlock, bytes.size() - at);
    const std::uint8_t is_last = at + length == bytes.size() ? 1 : 0;
    out.insert(out.end(), {is_last, part(length, 0), part(length, 8), part(~length, 0), part(~length, 8)});
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    out.insert(out.end(), begin, begin + static_cast<std::ptrdiff_t>(length));
    at += length;
  } while (at < bytes.size());
  const std::uint32_t sum = adler(bytes);
  for (const unsigned shift : {24U, 16U, 8U, 0U}) out.push_back(part(sum, shift));
  return out;
}

}  // namespace

PngFile::PngFile(int width_px, int height_px, int depth, PngColour colour, bool interlaced) {
  for (const std::uint32_t each : {0x89U, 0x50U, 0x4EU, 0x47U, 0x0DU, 0x0AU, 0x1AU, 0x0AU}) byte(each);
  std::vector<std::uint8_t> header;
  for (const int side_px : {width_px, height_px})
    for (const unsigned shift : {24U, 16U, 8U, 0U}) header.push_back(part(static_cast<std::size_t>(side_px), shift));
  header.insert(header.end(), {static_cast<std::uint8_t>(depth), static_cast<std::uint8_t>(colour), 0, 0,
                               static_cast<std::uint8_t>(interlaced ? 1 : 0)});
  chunk("IHDR", header);
}

void PngFile::word(std::uint32_t value) {
  for (const unsigned shift : {24U, 16U, 8U, 0U}) byte(value >> shift);
}

PngFile& PngFile::chunk(std::string_view type, const std::vector<std::uint8_t>& content) {
  word(static_cast<std::uint32_t>(content.size()));
  const std::size_t start = bytes_.size();
  for (const char letter : type) byte(static_cast<std::uint8_t>(letter));
  for (const std::uint8_t each : content) byte(each);
  word(crc(std::span(bytes_).subspan(start)));
  return *this;
}

PngFile& PngFile::pixels(const std::vector<std::uint8_t>& rows) { return chunk("IDAT", stored(rows)); }

std::vector<std::byte> PngFile::end() {
  chunk("IEND", {});
  return bytes_;
}

std::vector<std::byte> png_of(const ImageView& image) {
  const FrameFormat& format = image.format;
  const std::ptrdiff_t row_bytes = std::ptrdiff_t{format.width_px} * bytes_per_pixel(format.pixels);
  std::vector<std::uint8_t> rows;
  for (int v = 0; v < format.height_px; ++v) {
    rows.push_back(0);
    rows.insert(rows.end(), image.row(v), image.row(v) + row_bytes);
  }
  const PngColour colour = format.pixels == PixelFormat::gray8 ? PngColour::gray : PngColour::rgb;
  return PngFile(format.width_px, format.height_px, 8, colour).pixels(rows).end();
}

}  // namespace azimuth::test
