#include "base/files.hpp"

#include <cerrno>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/packed_file.hpp"
#include "base/unique_fd.hpp"

namespace azimuth {

FileResult<MappedFile> MappedFile::open(const std::filesystem::path& file) {
  // Without O_NONBLOCK, open() would block on a named pipe, which is refused below.
  const UniqueFd fd(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!fd) return failure(system_error(file, "cannot be opened", errno));
  struct stat status {};
  if (::fstat(fd.get(), &status) != 0) return failure(system_error(file, "cannot be read", errno));
  if (!S_ISREG(status.st_mode)) return failure(FileError{file.string(), 0, "is not a regular file"});
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size == 0) return MappedFile(Bytes{});
  void* const start = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, fd.get(), 0);
  if (start == MAP_FAILED) return failure(system_error(file, "cannot be read", errno));
  ::madvise(start, size, MADV_SEQUENTIAL);  // Only a hint; a failure costs only speed
  return MappedFile(Bytes(static_cast<const std::byte*>(start), size));
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

FileResult<std::string> read_text_file(const std::filesystem::path& file) {
  const FileResult<MappedFile> mapped = MappedFile::open(file);
  if (!mapped) return failure(mapped.error());
  const Bytes bytes = mapped->bytes();
  if (bytes.empty()) return std::string{};
  if (const std::string_view packed = packed_as(bytes); !packed.empty())
    return failure(FileError{file.string(), 0, std::string(packed)});
  return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

FileResult<void> write_text_file(const std::filesystem::path& file, std::string_view text) {
  const UniqueFd fd(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
  if (!fd) return failure(system_error(file, "cannot be written", errno));
  if (const int error = write_all(fd.get(), std::as_bytes(std::span(text)))) {
    return failure(system_error(file, "cannot be written", error));
  }
  return {};
}

int write_all(int fd, Bytes bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

}  // namespace azimuth
