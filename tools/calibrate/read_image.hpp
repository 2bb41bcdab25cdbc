#pragma once
// Reads image files for calibration: JPEG, PNG, and binary PGM and PPM.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/file_result.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// An image that owns its memory. Rows have no padding.
struct ImageFile {
  FrameFormat format;  ///< gray8 or rgb8
  std::vector<std::byte> bytes;

  ImageView view() const { return {format, bytes}; }
};

/// True if the file name ends in .jpg, .jpeg, .png, .pgm, .ppm or .pnm, in upper or lower case.
bool is_image_name(const std::filesystem::path& file);

/// Decodes the bytes of a JPEG, PNG, binary PGM or binary PPM file with 8 bits per sample. The first bytes determine
/// the format. Errors name `file`. Any input bytes are safe.
FileResult<ImageFile> decode_image(std::span<const std::byte> bytes, const std::string& file);

FileResult<ImageFile> read_image(const std::filesystem::path& file);

}  // namespace azimuth
