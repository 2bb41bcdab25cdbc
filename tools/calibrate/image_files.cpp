#include "tools/calibrate/image_files.hpp"

#include <algorithm>
#include <system_error>

#include "tools/calibrate/read_image.hpp"

namespace azimuth {
namespace {

using Path = std::filesystem::path;

std::vector<Path> images_in(const Path& folder) {
  std::error_code error;
  std::vector<Path> files;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (is_image_name(entry->path())) files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<Path> images_of(const Path& argument) {
  std::error_code error;
  if (!std::filesystem::is_directory(argument, error)) return {argument};
  const Path frames = argument / "frames";
  return images_in(std::filesystem::is_directory(frames, error) ? frames : argument);
}

template <class Thing>
std::vector<Thing> evenly(const std::vector<Thing>& all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<Thing> chosen;
  for (std::size_t i = 0; i < most; ++i) chosen.push_back(all[i * all.size() / most]);
  return chosen;
}

}  // namespace

FileResult<std::vector<Path>> image_files(const std::vector<Path>& arguments, std::size_t most) {
  std::vector<Path> files;
  for (const Path& argument : arguments) {
    const std::vector<Path> images = images_of(argument);
    if (images.empty()) return failure(FileError{argument.string(), 0, "there are no images in it"});
    files.insert(files.end(), images.begin(), images.end());
  }
  return evenly(files, most);
}

std::vector<std::pair<Path, Path>> image_pairs(const std::vector<Path>& files, std::size_t most) {
  std::vector<std::pair<Path, Path>> pairs;
  for (std::size_t i = 1; i < files.size(); ++i) pairs.emplace_back(files[i - 1], files[i]);
  return evenly(pairs, most);
}

}  // namespace azimuth
