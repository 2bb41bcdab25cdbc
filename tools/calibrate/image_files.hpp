#pragma once
// Finds and reads image files for calibration: JPEG, PNG, and binary PGM and PPM.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/file_result.hpp"
#include "slam/sample/image.hpp"

namespace azimuth {

/// The image files that command-line arguments name. A file stands for itself, a folder for all its images sorted by
/// name, a run folder for the images in its `frames` folder. If there are more than `most`, returns an evenly spaced
/// selection of `most`.
FileResult<std::vector<std::filesystem::path>> image_files(const std::vector<std::filesystem::path>& arguments,
                                                           std::size_t most);

/// Pairs of successive `files`. If there are more than `most` pairs, returns an evenly spaced selection of `most`.
std::vector<std::pair<std::filesystem::path, std::filesystem::path>> image_pairs(
    const std::vector<std::filesystem::path>& files, std::size_t most);

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
