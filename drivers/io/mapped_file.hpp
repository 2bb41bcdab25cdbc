#pragma once
#include <filesystem>
#include <utility>

#include "base/file_result.hpp"
#include "drivers/io/event_codec.hpp"

namespace azimuth {

/// The bytes of a regular file as they were when it was opened, mapped into memory. The file may grow meanwhile, which
/// is not seen, but must not shrink.
class MappedFile {
 public:
  static FileResult<MappedFile> open(const std::filesystem::path& file);
  MappedFile(MappedFile&& other) noexcept : bytes_(std::exchange(other.bytes_, Bytes{})) {}
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(MappedFile&&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  Bytes bytes() const { return bytes_; }

 private:
  explicit MappedFile(Bytes bytes) : bytes_(bytes) {}

  Bytes bytes_;
};

}  // namespace azimuth
