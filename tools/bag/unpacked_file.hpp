#pragma once
// Unpacks ROS 2 bag files that are compressed as a whole, and messages that are compressed individually.

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

#include "base/bytes.hpp"
#include "base/file_result.hpp"

namespace azimuth {

// Limits the work of unpacking and searching a bag, since a file of some hundred bytes may contain chunks that unpack
// to gigabytes.

/// Any file may unpack to this size.
inline constexpr std::uint64_t kFreeUnpackingBytes = std::uint64_t{32} << 20U;
/// In addition, a file may unpack to this multiple of its size. Odometry is compressed to a twentieth; repeated images
/// are compressed more.
inline constexpr std::uint64_t kUnpackingRatio = 64;
/// Cost of testing whether a record begins at a byte outside any record, in units of unpacking one byte.
inline constexpr std::uint64_t kLookingForARecord_B = 8;

/// The budget of one file for all its chunks. Work is counted in bytes (read, produced, and searched for a record), so
/// that a file gives the same result on any machine.
///
/// Thread contract: thread-bound.
class UnpackBudget {
 public:
  explicit UnpackBudget(std::uint64_t given_B) : left_B_(kFreeUnpackingBytes + kUnpackingRatio * given_B) {}

  /// Consumes budget. False from the first call on for which the budget is insufficient.
  bool spend(std::uint64_t bytes) {
    is_overdrawn_ = is_overdrawn_ || bytes > left_B_;
    left_B_ -= std::min(bytes, left_B_);
    return !is_overdrawn_;
  }
  bool is_overdrawn() const { return is_overdrawn_; }

 private:
  std::uint64_t left_B_;
  bool is_overdrawn_ = false;
};

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
