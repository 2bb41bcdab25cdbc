#pragma once
// Files that were compressed as a whole and messages that were one by one, as ROS 2 does with those of a bag.

#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

#include "base/bytes.hpp"
#include "base/file_result.hpp"
#include "tools/bag/unpack_budget.hpp"

namespace azimuth {

/// A temporary file, which goes with this. Thread contract: thread-bound.
class UnpackedFile {
 public:
  /// What zstd packed. Refuses what is not whole, and what unpacks to more than most_unpacked(); `file` is what errors
  /// name.
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

/// What zstd packed in a message, at most `most` bytes; false: it is damaged, cut, or more. Reentrant.
bool unpack_message(Bytes packed, std::uint64_t most, std::vector<std::byte>& out);

/// What so many bytes of a bag may come to, by what an UnpackBudget allows.
constexpr std::uint64_t most_unpacked(std::uint64_t packed_B) {
  return kFreeUnpackingBytes + kUnpackingRatio * packed_B;
}

}  // namespace azimuth
