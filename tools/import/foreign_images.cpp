#include "tools/import/foreign_images.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <fstream>
#include <span>
#include <system_error>

#include "base/packed_file.hpp"
#include "drivers/wire/image_header.hpp"
#include "tools/import/foreign_table.hpp"

namespace azimuth {

namespace fs = std::filesystem;

namespace {

std::string extension_of(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
  return extension;
}

bool is_image_file(const fs::path& file) {
  const std::string extension = extension_of(file);
  return extension == ".jpg" || extension == ".jpeg" || extension == ".png";
}

/// Format by the first bytes: "jpg" or "png"; empty if the file is neither or cannot be read.
std::string_view format_of(const fs::path& file) {
  std::array<char, 8> start{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(start.data(), start.size());
  if (is_png(std::as_bytes(std::span(start)))) return "png";
  const bool is_jpeg = static_cast<unsigned char>(start[0]) == 0xff && static_cast<unsigned char>(start[1]) == 0xd8;
  return is_jpeg ? "jpg" : "";
}

/// Error text for a file that is neither JPEG nor PNG.
std::string what_it_is(const fs::path& file) {
  std::array<char, 64> start{};
  std::ifstream stream(file, std::ios::binary);
  stream.read(start.data(), start.size());
  const Bytes begin = std::as_bytes(std::span(start)).first(static_cast<std::size_t>(stream.gcount()));
  const std::string_view packed = packed_as(begin);
  return packed.empty() ? "is neither JPEG nor PNG" : std::string(packed);
}

bool is_part_of_number(char c) { return (c >= '0' && c <= '9') || c == '.'; }

bool is_file(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored);
}

/// True, and counted, if a file exists and is empty.
bool was_empty(const fs::path& file, std::uint64_t& count) {
  std::error_code error;
  const bool is_empty = is_file(file) && fs::file_size(file, error) == 0 && !error;
  if (is_empty) ++count;
  return is_empty;
}

/// Sorts by stamp. Two images with the same stamp are an error.
void put_in_order(std::vector<SourceImage>& images, FileErrorList& errors) {
  std::stable_sort(images.begin(), images.end(),
                   [](const SourceImage& a, const SourceImage& b) { return a.stamp < b.stamp; });
  for (std::size_t i = 1; i < images.size(); ++i)
    if (images[i].stamp == images[i - 1].stamp)
      errors.add(0, images[i - 1].file.filename().string() + " and " + images[i].file.filename().string() +
                        " have the same stamp");
}

/// The path relative to `folder`; empty if the file is not below it.
std::string below(const fs::path& file, const fs::path& folder) {
  std::error_code error;
  const fs::path relative = fs::relative(file, folder, error);
  const bool inside = !error && !relative.empty() && relative.is_relative() && *relative.begin() != "..";
  return inside ? relative.string() : std::string();
}

}  // namespace

std::optional<Stamp> stamp_in_name(std::string_view stem, int digits) {
  while (!stem.empty() && (!is_part_of_number(stem.back()) || stem.back() == '.')) stem.remove_suffix(1);
  std::size_t begin = stem.size();
  while (begin > 0 && is_part_of_number(stem[begin - 1])) --begin;
  while (begin < stem.size() && stem[begin] == '.') ++begin;
  return begin < stem.size() ? parse_time(stem.substr(begin), digits) : std::nullopt;
}

FileResult<std::vector<SourceImage>> images_by_name(const fs::path& folder, std::string_view unit,
                                                    std::uint64_t& empty) {
  const std::optional<int> digits = digits_of_time(unit);
  if (!digits) return failure(FileError{"--stamps name[" + std::string(unit) + ']', 0, "must be one of s, ms, us, ns"});
  std::error_code error;
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (is_image_file(entry->path()) && !was_empty(entry->path(), empty)) files.push_back(entry->path());
  if (error) return failure(system_error(folder.string(), "cannot be read", error.value()));
  std::sort(files.begin(), files.end());
  FileErrorList errors(folder.string());
  if (files.empty())
    errors.add(0, empty > 0 ? "not one image in it has a byte" : "there are no images in it: JPEG or PNG files");
  std::vector<SourceImage> images;
  const std::string hint = *digits == 0 ? ": --stamps name[ns]?" : "";
  const auto stamp_of = [&](const fs::path& file) { return stamp_in_name(file.stem().string(), *digits); };
  if (files.size() > 1 && std::ranges::none_of(files, [&](const fs::path& file) { return stamp_of(file).has_value(); }))
    return failure(FileError{folder.string(), 0,
                             "of " + std::to_string(files.size()) + " names, such as " +
                                 files.front().filename().string() + ", none holds a time in " + std::string(unit) +
                                 " that is in range" + hint});
  for (const fs::path& file : files) {
    const std::optional<Stamp> stamp = stamp_of(file);
    const std::string name = file.filename().string();
    if (!stamp)
      errors.add(0, fmt::format("{}: its name holds no time in {}, or one out of range{}", name, unit, hint));
    else if (format_of(file).empty())
      errors.add(0, name + ": " + what_it_is(file));
    else
      images.push_back({*stamp, fs::absolute(file)});
  }
  put_in_order(images, errors);
  FileErrors all;
  std::move(errors).move_to(all);
  if (!all.empty()) return failure(std::move(all));
  return images;
}

FileResult<std::vector<SourceImage>> images_by_table(const fs::path& folder, const ForeignText& table,
                                                     std::uint64_t& empty) {
  const FileResult<std::vector<StampedFile>> rows = foreign_files(table);
  if (!rows) return failure(rows.error());
  FileErrorList errors(table.file);
  std::vector<SourceImage> images;
  for (const StampedFile& row : *rows) {
    const fs::path beside = folder / row.file, own = fs::path(table.file).parent_path() / row.file;
    const fs::path& file = is_file(beside) ? beside : own;
    if (was_empty(file, empty)) continue;
    if (!is_file(file))
      errors.add(row.line, "there is no file " + beside.string());
    else if (format_of(file).empty())
      errors.add(row.line, file.string() + ' ' + what_it_is(file));
    else
      images.push_back({row.stamp, fs::absolute(file)});
  }
  FileErrors all;
  std::move(errors).move_to(all);
  if (!all.empty()) return failure(std::move(all));
  return images;
}

std::string numbered_image(std::size_t number, std::string_view extension) {
  std::string digits = std::to_string(number);
  if (digits.size() < 6) digits.insert(0, 6 - digits.size(), '0');
  return "frames/" + digits + '.' + std::string(extension);
}

FileResult<void> make_frames_folder(const fs::path& out) {
  std::error_code error;
  fs::create_directories(out / "frames", error);
  if (error) return failure(system_error((out / "frames").string(), "cannot be made", error.value()));
  return {};
}

FileResult<std::vector<FrameFile>> bring_images(const std::vector<SourceImage>& images, const fs::path& out,
                                                const fs::path& files, const WriteProgress& progress) {
  std::vector<FrameFile> frames;
  bool has_folder = false;
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (progress) progress(i, images.size());
    std::string name = below(images[i].file, out);
    if (name.empty()) {
      if (!has_folder)
        if (auto made = make_frames_folder(files); !made) return failure(made.error());
      has_folder = true;
      name = numbered_image(i, format_of(images[i].file));
      // An existing file may be a link to the only copy of other data, which writing would overwrite.
      std::error_code error;
      fs::remove(files / name, error);
      if (!error) fs::copy_file(images[i].file, files / name, error);
      if (error) return failure(system_error((out / name).string(), "cannot be written", error.value()));
    }
    frames.push_back({images[i].stamp, std::move(name)});
  }
  return frames;
}

}  // namespace azimuth
