#include "drivers/camera/shared_frames.hpp"

#include <cerrno>
#include <fcntl.h>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/stat.h>

namespace azimuth::camera_link {

namespace {

constexpr int kFixedSize = F_SEAL_SHRINK | F_SEAL_GROW;

bool is_of_fixed_size(int fd, std::size_t bytes) {
  struct stat status {};
  const int seals = ::fcntl(fd, F_GET_SEALS);  // fails for anything but a memfd
  return seals >= 0 && (seals & kFixedSize) == kFixedSize && ::fstat(fd, &status) == 0 && status.st_size >= 0 &&
         static_cast<std::size_t>(status.st_size) == bytes;
}

}  // namespace

FrameMemory FrameMemory::create(std::size_t bytes, int& error) {
  FrameMemory memory;
  memory.fd_ = UniqueFd(::memfd_create("azimuth-frames", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  error = memory.fd_ ? ::posix_fallocate(memory.fd_.get(), 0, static_cast<off_t>(bytes)) : errno;
  if (error != 0) return {};
  void* const start = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, memory.fd_.get(), 0);
  if (start == MAP_FAILED) {
    error = errno;
    return {};
  }
  memory.bytes_ = {static_cast<std::byte*>(start), bytes};
  // The mapping made above stays writable; later mappings are not.
  if (::fcntl(memory.fd_.get(), F_ADD_SEALS, kFixedSize | F_SEAL_FUTURE_WRITE | F_SEAL_SEAL) != 0) {
    error = errno;
    return {};
  }
  return memory;
}

FrameMemory::~FrameMemory() {
  if (!bytes_.empty()) ::munmap(bytes_.data(), bytes_.size());
}

std::shared_ptr<MappedFrames> MappedFrames::open(const UniqueFd& memory, const Hello& hello, int& error) {
  error = EPROTO;
  const std::size_t size = hello.memory_bytes();
  if (!memory || !is_of_fixed_size(memory.get(), size)) return nullptr;
  UniqueFd bell(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC));
  void* const start = bell ? ::mmap(nullptr, size, PROT_READ, MAP_SHARED, memory.get(), 0) : MAP_FAILED;
  error = start == MAP_FAILED ? errno : 0;
  if (error != 0) return nullptr;
  return std::make_shared<MappedFrames>(
      std::move(bell), std::span<const std::byte>(static_cast<const std::byte*>(start), size), hello.slot_bytes);
}

MappedFrames::~MappedFrames() { ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size()); }

}  // namespace azimuth::camera_link
