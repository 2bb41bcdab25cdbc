#pragma once
// Images of a real camera in a folder of the test data.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <string>
#include <vector>

#include "drivers/camera/jpeg.hpp"
#include "drivers/camera/png.hpp"
#include "slam/camera/camera_rig.hpp"
#include "tests/perception/rendered_images.hpp"
#include "tests/support/data.hpp"

namespace azimuth::test {

struct CameraImages {
  const char *folder, *name_begins;
  PixelPoint centre_px;
  double inner_px, outer_px;

  ImageRig rig() const {
    ImageRig rig;
    rig.centre_px = centre_px;
    rig.mask_inner_px = inner_px;
    rig.mask_outer_px = outer_px;
    return rig;
  }

  /// The files in the order of their names.
  std::vector<std::filesystem::path> files() const {
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(data_folder() / folder))
      if (entry.path().filename().string().starts_with(name_begins)) found.push_back(entry.path());
    std::ranges::sort(found);
    return found;
  }
};

inline std::ostream& operator<<(std::ostream& out, const CameraImages& camera) {
  return out << camera.folder << ' ' << camera.name_begins;
}

/// Reads an image in grey; the result has no pixels if the file is not an image.
inline Image read_image(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  const auto content = std::as_bytes(std::span(bytes));
  JpegDecoder jpeg;
  PngDecoder png;
  const ImageView view =
      file.extension() == ".png" ? png.decode(content, PixelFormat::gray8) : jpeg.decode(content, PixelFormat::gray8);
  return {view.format, {view.bytes.begin(), view.bytes.end()}};
}

}  // namespace azimuth::test
