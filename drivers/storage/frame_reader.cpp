#include "drivers/storage/frame_reader.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <span>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include "base/unique_fd.hpp"
#include "drivers/wire/image_header.hpp"

namespace azimuth {

namespace {

/// Size of a file that may be a frame; 0: it cannot be one, and `problem` tells why.
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

/// Fills `out`. Returns the number of bytes read before the end of the file or an error, whose cause goes to `problem`.
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

/// The contents of the file, in storage that only grows. Empty: `problem` tells why.
std::span<const std::byte> read_whole(const std::string& file, std::vector<std::byte>& storage, std::string& problem) {
  // Without O_NONBLOCK, opening a named pipe would block before it can be refused.
  const UniqueFd fd(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  const std::size_t size = frame_size(fd, problem);
  if (storage.size() < size) storage.resize(size);
  const std::size_t got = read_until_full(fd, std::span(storage).first(size), problem);
  if (got == 0 && problem.empty()) problem = "is empty";
  return std::span(storage).first(problem.empty() ? got : 0);
}

}  // namespace

ImageView FrameReader::read(const FrameFile& frame) {
  problem_.clear();
  return frame.part ? read_part(frame, *frame.part) : read_file(frame);
}

ImageView FrameReader::read_file(const FrameFile& frame) {
  const Bytes bytes = read_whole(folder_ / frame.file, file_, problem_);
  if (bytes.empty()) return {};
  const auto [width_px, height_px] = jpeg_size(bytes).value_or(std::pair{0, 0});
  return {packed_format(PixelFormat::mjpeg, width_px, height_px), bytes};
}

ImageView FrameReader::read_part(const FrameFile& frame, const FramePart& part) {
  if (part.size == 0) return problem_ = "is empty", ImageView{};
  if (!map(folder_ / frame.file)) return {};
  const Bytes log = log_->bytes();
  if (part.offset > log.size() || part.size > log.size() - part.offset)
    return problem_ = "has become shorter", ImageView{};
  return {part.format, log.subspan(part.offset, part.size)};
}

/// Maps a log. The frames of one log are read consecutively, so one mapping at a time is sufficient.
bool FrameReader::map(const std::filesystem::path& log) {
  if (log_ && mapped_ == log) return true;
  log_.reset();
  FileResult<MappedFile> mapped = MappedFile::open(log);
  if (!mapped) {
    problem_ = mapped.error().front().message;
    return false;
  }
  log_ = std::make_unique<MappedFile>(*std::move(mapped));
  mapped_ = log;
  return true;
}

}  // namespace azimuth
