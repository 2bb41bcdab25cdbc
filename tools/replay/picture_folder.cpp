#include "tools/replay/picture_folder.hpp"

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <fmt/format.h>
#include <fstream>
#include <system_error>
#include <utility>

namespace azimuth {
namespace {

constexpr int kQuality = 85;

}  // namespace

PictureFolder::PictureFolder(const Run& run, const CameraRig& rig, std::filesystem::path folder, std::size_t every)
    : run_(run), folder_(std::move(folder)), every_(every), images_(run), picture_(rig) {
  assert(every > 0);
}

void PictureFolder::before_update(const BearingSet& set, const Estimator& estimator) {
  const auto frame = std::ranges::lower_bound(run_.frames, set.stamp, {}, &FrameFile::stamp);
  if (frame == run_.frames.end() || frame->stamp != set.stamp) return;
  const auto index = static_cast<std::size_t>(frame - run_.frames.begin());
  if (index % every_ != 0) return;
  estimator.expect(expected_);
  const ImageView drawn = picture_.draw(images_.pixels(index, PixelFormat::rgb8), set, expected_);
  write(index, encoder_.encode(drawn, kQuality));
}

void PictureFolder::write(std::size_t index, std::span<const std::byte> jpeg) {
  const std::filesystem::path file = folder_ / fmt::format("{:06}.jpg", index);
  errno = 0;
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(jpeg.data()), static_cast<std::streamsize>(jpeg.size()));
  stream.close();
  if (stream)
    ++written_;
  else if (problem_.empty())
    problem_ = file.string() + ": " + std::generic_category().message(errno);
}

}  // namespace azimuth
