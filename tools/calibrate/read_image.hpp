#pragma once
// Image files for calibration: JPEG, PNG, and the raw formats that every program writes.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// An image that owns its memory, rows without padding.
struct ImageFile {
  FrameFormat format;  ///< gray8 or rgb8
  std::vector<std::byte> bytes;

  ImageView view() const { return {format, bytes}; }
};

/// Whether a file's name is that of an image: .jpg, .jpeg, .png, .pgm, .ppm or .pnm, in any case.
bool is_image_name(const std::filesystem::path& file);

/// The image in the bytes of a JPEG, PNG, PGM or PPM file (binary, 8 bits a sample), told apart by their first bytes;
/// `file` is what errors name. Any bytes are safe.
FileResult<ImageFile> decode_image(std::span<const std::byte> bytes, const std::string& file);

FileResult<ImageFile> read_image(const std::filesystem::path& file);

}  // namespace azimuth
