#pragma once
// Unpacks ROS 2 bag files that are compressed as a whole, and messages that are compressed individually.

#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

#include "base/bytes.hpp"
#include "base/file_result.hpp"
#include "tools/bag/unpack_budget.hpp"

namespace azimuth {

/// An unpacked temporary file, which the destructor deletes. Thread contract: thread-bound.
class UnpackedFile {
 public:
  /// Unpacks zstd data. Fails if the data is incomplete or unpacks to more than most_unpacked(). Errors name `file`.
  static FileResult<UnpackedFile> make(const std::filesystem::path& file, Bytes packed);
  UnpackedFile(UnpackedFile&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  UnpackedFile(const UnpackedFile&) = delete;
  UnpackedFile& operator=(UnpackedFile&&) = delete;
  UnpackedFile& operator=(const UnpackedFile&) = delete;
  ~UnpackedFile();

  const std::filesystem::path& path() const { return path_; }

 private:
  explicit UnpackedFile(std::filesystem::path path) : path_(std::move(path)) {}

  std::filesystem::path path_;
};

/// Unpacks a zstd message of at most `most` bytes. False if it is damaged, truncated or larger. Reentrant.
bool unpack_message(Bytes packed, std::uint64_t most, std::vector<std::byte>& out);

/// Largest unpacked size that an UnpackBudget allows for `packed_B` bytes.
constexpr std::uint64_t most_unpacked(std::uint64_t packed_B) {
  return kFreeUnpackingBytes + kUnpackingRatio * packed_B;
}

}  // namespace azimuth
