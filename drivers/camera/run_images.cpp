#include "drivers/camera/run_images.hpp"

#include "drivers/wire/image_header.hpp"

namespace azimuth {

ImageView RunImages::refuse(std::size_t index, const std::string& why) {
  problem_ = run_.frames[index].file + ": " + why;
  return {};
}

/// Without bytes: refused.
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
  if (is_png(image.bytes)) return decode_png(index, image.bytes, std::nullopt);
  const std::optional<JpegHeader> header = jpeg_.read_header(image.bytes);
  if (!header) return refuse(index, jpeg_.problem());
  return {packed_format(PixelFormat::mjpeg, header->width_px, header->height_px), image.bytes};
}

ImageView RunImages::pixels(std::size_t index, PixelFormat decoded) {
  const ImageView image = read(index);
  if (image.bytes.empty()) return image;
  const bool compressed = image.format.pixels == PixelFormat::mjpeg;
  if (compressed && is_png(image.bytes)) return decode_png(index, image.bytes, decoded);
  const ImageView pixels = jpeg_.uncompressed(image, decoded);
  return pixels.bytes.empty() ? refuse(index, jpeg_.problem()) : pixels;
}

/// Without a requested format, decodes to the format without loss.
ImageView RunImages::decode_png(std::size_t index, std::span<const std::byte> png, std::optional<PixelFormat> decoded) {
  const std::optional<PngHeader> header = png_.read_header(png);
  const ImageView pixels = header ? png_.decode(png, decoded.value_or(header->natural_format())) : ImageView{};
  return pixels.bytes.empty() ? refuse(index, png_.problem()) : pixels;
}

}  // namespace azimuth
