#pragma once
// Folders of images whose stamps stand in a table or in their names.
//
// Thread contract: reentrant.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_result.hpp"
#include "drivers/storage/write_run_log.hpp"
#include "slam/sample/stamp.hpp"
#include "tools/import/foreign_samples.hpp"

namespace azimuth {

/// Image files, absolute, in the order of their stamps, which increase strictly; each is JPEG or PNG by its first
/// bytes.
struct SourceImage {
  Stamp stamp{};
  std::filesystem::path file;
};

/// What is in a file name's last number, `digits` of it fractions of a second; nothing without one.
std::optional<Stamp> stamp_in_name(std::string_view stem, int digits);

/// The JPEG and PNG files of `folder`, by the numbers in their names: `unit` of time, s, ms, us or ns. Files without a
/// byte, of a camera or disk that had just failed, are left out and counted.
FileResult<std::vector<SourceImage>> images_by_name(const std::filesystem::path& folder, std::string_view unit,
                                                    std::uint64_t& empty);

/// The files that a table of t_s and file names, which are relative to `folder` or to the table's own; likewise.
FileResult<std::vector<SourceImage>> images_by_table(const std::filesystem::path& folder, const ForeignText& table,
                                                     std::uint64_t& empty);

/// Copies the images to `files`/frames, numbered, unless they lie below `out` already. For Run::frames of a folder
/// `out`, to which the files belong. What `progress` throws ends it.
FileResult<std::vector<FrameFile>> bring_images(const std::vector<SourceImage>& images,
                                                const std::filesystem::path& out, const std::filesystem::path& files,
                                                const WriteProgress& progress = {});

/// The name of image `number` of a run folder, with that extension: frames/000007.jpg.
std::string numbered_image(std::size_t number, std::string_view extension);

/// Makes `out`/frames for them.
FileResult<void> make_frames_folder(const std::filesystem::path& out);

}  // namespace azimuth
