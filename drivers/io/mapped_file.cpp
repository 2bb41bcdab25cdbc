#include "drivers/io/mapped_file.hpp"

#include <cerrno>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include "drivers/io/system_error.hpp"
#include "drivers/io/unique_fd.hpp"

namespace azimuth {

FileResult<MappedFile> MappedFile::open(const std::filesystem::path& file) {
  // Without O_NONBLOCK a named pipe would keep us waiting before we could refuse it.
  const UniqueFd fd(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!fd) return failure(system_error(file, "cannot be opened", errno));
  struct stat status {};
  if (::fstat(fd.get(), &status) != 0) return failure(system_error(file, "cannot be read", errno));
  if (!S_ISREG(status.st_mode)) return failure(FileError{file.string(), 0, "is not a regular file"});
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size == 0) return MappedFile(Bytes{});
  void* const start = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, fd.get(), 0);
  if (start == MAP_FAILED) return failure(system_error(file, "cannot be read", errno));
  ::madvise(start, size, MADV_SEQUENTIAL);  // only a hint: failure costs nothing but speed
  return MappedFile(Bytes(static_cast<const std::byte*>(start), size));
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

}  // namespace azimuth
