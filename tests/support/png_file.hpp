#pragma once
// PNG files by hand: every depth and colour type, without a library, and wrong ones.

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <utility>
#include <vector>

#include "slam/sample/image.hpp"

namespace azimuth::test {

/// The numbers of the format.
enum class PngColour : std::uint8_t { gray = 0, rgb = 2, palette = 3, gray_alpha = 4, rgb_alpha = 6 };

/// Chunks one after the other, each with its length and its sum.
class PngFile {
 public:
  PngFile(int width_px, int height_px, int depth, PngColour colour, bool interlaced = false);

  PngFile& chunk(std::string_view type, const std::vector<std::uint8_t>& content);
  /// The rows as they stand in the file, each behind the number of its filter; not compressed.
  PngFile& pixels(const std::vector<std::uint8_t>& rows);
  /// The last chunk, and with it the file.
  std::vector<std::byte> end();

 private:
  void byte(std::uint32_t value) { bytes_.push_back(static_cast<std::byte>(value & 0xFFU)); }
  void word(std::uint32_t value);

  std::vector<std::byte> bytes_;
};

/// Of gray8 or rgb8, rows with or without padding.
std::vector<std::byte> png_of(const ImageView& image);

}  // namespace azimuth::test
