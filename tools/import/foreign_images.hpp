#pragma once
// Imports folders of images whose stamps are in a table or in the file names.
//
// Thread contract: reentrant.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_result.hpp"
#include "drivers/storage/run.hpp"
#include "slam/sample/stamp.hpp"
#include "tools/import/foreign_samples.hpp"

namespace azimuth {

/// An image file with an absolute path. Lists of them are sorted by strictly increasing stamps. The first bytes of each
/// file identify it as JPEG or PNG.
struct SourceImage {
  Stamp stamp{};
  std::filesystem::path file;
};

/// The stamp in the last number of a file name, of which `digits` digits are fractions of a second; nothing if there is
/// no number.
std::optional<Stamp> stamp_in_name(std::string_view stem, int digits);

/// The JPEG and PNG files of `folder`, with stamps from the numbers in their names. `unit` is s, ms, us or ns. Empty
/// files, which result from a failing camera or disk, are left out and counted in `empty`.
FileResult<std::vector<SourceImage>> images_by_name(const std::filesystem::path& folder, std::string_view unit,
                                                    std::uint64_t& empty);

/// The files that a table with the columns t_s and file lists. File names are relative to `folder` or to the folder of
/// the table. Empty files are left out and counted.
FileResult<std::vector<SourceImage>> images_by_table(const std::filesystem::path& folder, const ForeignText& table,
                                                     std::uint64_t& empty);

/// Copies the images to `files`/frames with numbered names, unless they are already below `out`. Returns Run::frames
/// for the run folder `out`. `progress` may throw to end the copying.
FileResult<std::vector<FrameFile>> bring_images(const std::vector<SourceImage>& images,
                                                const std::filesystem::path& out, const std::filesystem::path& files,
                                                const WriteProgress& progress = {});

/// The name of image `number` in a run folder, for example frames/000007.jpg.
std::string numbered_image(std::size_t number, std::string_view extension);

/// Creates the folder `out`/frames.
FileResult<void> make_frames_folder(const std::filesystem::path& out);

}  // namespace azimuth
