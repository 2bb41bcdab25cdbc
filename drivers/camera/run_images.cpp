#include "drivers/camera/run_images.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "drivers/io/unique_fd.hpp"

namespace azimuth {

namespace {

/// Bytes of a file that may be a frame; 0: `problem` says why it may not.
std::size_t frame_size(const UniqueFd& fd, std::string& problem) {
  struct stat status {};
  if (!fd || ::fstat(fd.get(), &status) != 0) {
    problem = std::strerror(errno);
  } else if (!S_ISREG(status.st_mode)) {
    problem = "is not a regular file";
  } else if (status.st_size == 0) {
    problem = "is empty";
  } else if (static_cast<std::size_t>(status.st_size) > kMaxFrameFileBytes) {
    problem = "is too large";
  }
  return problem.empty() ? static_cast<std::size_t>(status.st_size) : 0;
}

/// Fills `out`; returns how far it got before the end of the file or an error, whose reason goes to `problem`.
std::size_t read_until_full(const UniqueFd& fd, std::span<std::byte> out, std::string& problem) {
  std::size_t got = 0;
  while (got < out.size()) {
    const ssize_t part = ::read(fd.get(), out.data() + got, out.size() - got);
    if (part < 0 && errno == EINTR) continue;
    if (part < 0) problem = std::strerror(errno);
    if (part <= 0) break;
    got += static_cast<std::size_t>(part);
  }
  return got;
}

/// What the file holds, in storage that grows but is not given back. Empty: `problem` says why.
std::span<const std::byte> read_whole(const std::string& file, std::vector<std::byte>& storage, std::string& problem) {
  // Without O_NONBLOCK a named pipe would keep us waiting before we could refuse it.
  const UniqueFd fd(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  const std::size_t size = frame_size(fd, problem);
  if (storage.size() < size) storage.resize(size);
  const std::size_t got = read_until_full(fd, std::span(storage).first(size), problem);
  if (got == 0 && problem.empty()) problem = "is empty";
  return std::span(storage).first(problem.empty() ? got : 0);
}

}  // namespace

ImageView RunImages::refuse(const FrameFile& frame, const std::string& why) {
  problem_ = frame.file + ": " + why;
  return {};
}

std::span<const std::byte> RunImages::file_of(const FrameFile& frame) {
  std::string problem;
  const auto bytes = read_whole(run_.folder / frame.file, file_, problem);
  problem_.clear();
  if (!problem.empty()) refuse(frame, problem);
  return bytes;
}

ImageView RunImages::recorded(std::size_t index) {
  const FrameFile& frame = run_.frames.at(index);
  const auto bytes = file_of(frame);
  if (bytes.empty()) return {};
  const std::optional<JpegHeader> header = decoder_.read_header(bytes);
  if (!header) return refuse(frame, decoder_.problem());
  return {packed_format(PixelFormat::mjpeg, header->width_px, header->height_px), bytes};
}

ImageView RunImages::pixels(std::size_t index, PixelFormat decoded) {
  const FrameFile& frame = run_.frames.at(index);
  const auto bytes = file_of(frame);
  if (bytes.empty()) return {};
  const ImageView image = decoder_.decode(bytes, decoded);
  return image.bytes.empty() ? refuse(frame, decoder_.problem()) : image;
}

}  // namespace azimuth
