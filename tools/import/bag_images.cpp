#include <cerrno>
#include <fcntl.h>
#include <system_error>

#include "base/files.hpp"
#include "base/unique_fd.hpp"
#include "drivers/camera/png.hpp"
#include "drivers/wire/image_header.hpp"
#include "tools/import/bag_run.hpp"
#include "tools/import/foreign_images.hpp"

namespace azimuth {
namespace {

FileResult<FrameFile> write_image(const std::filesystem::path& out, const std::string& name, Stamp stamp, Bytes bytes) {
  std::error_code ignored;  // an existing file may be a link to the only copy of other data
  std::filesystem::remove(out / name, ignored);
  if (auto written = write_text_file(out / name, as_text(bytes)); !written) return failure(written.error());
  return FrameFile{stamp, name};
}

}  // namespace

FileResult<FrameFile> FolderImages::keep(std::size_t number, Stamp stamp, const ImageView& image) {
  const bool compressed = image.format.pixels == PixelFormat::mjpeg;
  if (!compressed && !png_holds(image.format.pixels))
    return failure(FileError{out_.string(), 0,
                             "a run folder cannot hold " + std::string(name(image.format.pixels)) +
                                 " images without loss; an LCM log can: let OUT end in .lcmlog"});
  if (number == 0)
    if (auto made = make_frames_folder(files_); !made) return failure(made.error());
  if (compressed)
    return write_image(files_, numbered_image(number, is_png(image.bytes) ? "png" : "jpg"), stamp, image.bytes);
  const std::vector<std::byte> png = encode_png(image);
  if (png.empty()) return failure(FileError{out_.string(), 0, "an image cannot be made a PNG file"});
  return write_image(files_, numbered_image(number, "png"), stamp, png);
}

LogImages::LogImages(const std::filesystem::path& log) : file_(std::filesystem::absolute(log).string() + ".images") {}

LogImages::~LogImages() {
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
}

FileResult<FrameFile> LogImages::keep(std::size_t number, Stamp stamp, const ImageView& image) {
  ImageView kept = image;
  PngDecoder png;  // PixelFormat has no value for PNG
  if (image.format.pixels == PixelFormat::mjpeg && is_png(image.bytes)) {
    const std::optional<PngHeader> header = png.read_header(image.bytes);
    kept = header ? png.decode(image.bytes, header->natural_format()) : ImageView{};
  }
  const int flags = O_WRONLY | O_CREAT | O_CLOEXEC | (number == 0 ? O_TRUNC : O_APPEND);
  const UniqueFd fd(::open(file_.c_str(), flags, 0644));
  if (!fd) return failure(system_error(file_.string(), "cannot be written", errno));
  if (const int error = write_all(fd.get(), kept.bytes))
    return failure(system_error(file_.string(), "cannot be written", error));
  const FramePart part{size_, kept.bytes.size(), kept.format};
  size_ += kept.bytes.size();
  return FrameFile{stamp, file_.string(), part};
}

}  // namespace azimuth
