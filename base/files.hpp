#pragma once
// Whole regular files: mapping, reading and writing.
//
// Thread contract: reentrant.

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "base/bytes.hpp"
#include "base/file_result.hpp"

namespace azimuth {

/// The bytes of a regular file, mapped into memory, as they were when it was opened. The file may grow meanwhile, which
/// has no effect, but it must not shrink.
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

/// Reads a whole text file. Refuses a packed file and says how to unpack it.
FileResult<std::string> read_text_file(const std::filesystem::path& file);

/// Replaces the file's content.
[[nodiscard]] FileResult<void> write_text_file(const std::filesystem::path& file, std::string_view text);

/// Writes all of `bytes` to a descriptor; returns 0 or the errno.
[[nodiscard]] int write_all(int fd, Bytes bytes);

}  // namespace azimuth
