#pragma once
// Writes PNG files without a library: all bit depths and colour types, and invalid files.

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <utility>
#include <vector>

#include "slam/sample/image.hpp"

namespace azimuth::test {

/// Colour types, numbered as in the PNG format.
enum class PngColour : std::uint8_t { gray = 0, rgb = 2, palette = 3, gray_alpha = 4, rgb_alpha = 6 };

/// Appends chunks, each with its length and its checksum.
class PngFile {
 public:
  PngFile(int width_px, int height_px, int depth, PngColour colour, bool interlaced = false);

  PngFile& chunk(std::string_view type, const std::vector<std::uint8_t>& content);
  /// Appends the rows as they are in the file, uncompressed, each preceded by its filter number.
  PngFile& pixels(const std::vector<std::uint8_t>& rows);
  /// Appends the last chunk and returns the file.
  std::vector<std::byte> end();

 private:
  void byte(std::uint32_t value) { bytes_.push_back(static_cast<std::byte>(value & 0xFFU)); }
  void word(std::uint32_t value);

  std::vector<std::byte> bytes_;
};

/// A PNG file of a gray8 or rgb8 image, whose rows may be padded.
std::vector<std::byte> png_of(const ImageView& image);

}  // namespace azimuth::test
