#include "drivers/camera/run_images.hpp"

namespace azimuth {

ImageView RunImages::refuse(std::size_t index, const std::string& why) {
  problem_ = run_.frames[index].file + ": " + why;
  return {};
}

/// No bytes: refused.
ImageView RunImages::read(std::size_t index) {
  problem_.clear();
  const ImageView image = reader_.read(run_.frames.at(index));
  if (image.bytes.empty()) return refuse(index, reader_.problem());
  if (image.format.pixels != PixelFormat::mjpeg && !image.readable()) return refuse(index, "is not whole");
  return image;
}

ImageView RunImages::recorded(std::size_t index) {
  const ImageView image = read(index);
  if (image.bytes.empty() || image.format.pixels != PixelFormat::mjpeg) return image;
  const std::optional<JpegHeader> header = decoder_.read_header(image.bytes);
  if (!header) return refuse(index, decoder_.problem());
  return {packed_format(PixelFormat::mjpeg, header->width_px, header->height_px), image.bytes};
}

ImageView RunImages::pixels(std::size_t index, PixelFormat decoded) {
  const ImageView image = read(index);
  if (image.bytes.empty() || image.format.pixels != PixelFormat::mjpeg) return image;
  const ImageView pixels = decoder_.decode(image.bytes, decoded);
  return pixels.bytes.empty() ? refuse(index, decoder_.problem()) : pixels;
}

}  // namespace azimuth
