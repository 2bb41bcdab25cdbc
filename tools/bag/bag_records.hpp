#pragma once
// Readers of bag formats: ROS 1 (2.0), MCAP, and SQLite databases of ROS 2. Other libraries need an index at the end,
// which truncated recordings lack, and trust all lengths. These readers accept any bytes and find all complete records.
// Databases are read with the SQLite library.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/bytes.hpp"
#include "slam/sample/stamp.hpp"
#include "tools/bag/ros_definition.hpp"
#include "tools/bag/unpacked_file.hpp"

namespace azimuth {

/// A text with shared ownership, since many MCAP channels may use the same schema.
class SharedText {
 public:
  SharedText() : SharedText(std::string{}) {}
  SharedText(std::string text) : text_(std::make_shared<const std::string>(std::move(text))) {}  // NOLINT: is a text
  SharedText(const char* text) : SharedText(std::string(text)) {}                                // NOLINT: is a text
  operator std::string_view() const { return *text_; }                                           // NOLINT: is a text
  friend bool operator==(const SharedText& a, const SharedText& b) {
    return a.text_ == b.text_ || *a.text_ == *b.text_;
  }

 private:
  std::shared_ptr<const std::string> text_;
};

/// Properties of the messages of a publisher.
struct BagConnection {
  std::uint32_t id = 0;
  std::string topic;
  std::string type;       ///< for example sensor_msgs/Image, also in ROS 2; other types have the encoding in brackets
  SharedText definition;  ///< message definition, for RosDefinition
  std::string checksum;   ///< checksum of the definition
  RosVersion version = RosVersion::one;
  std::string sender = {};  ///< the sending node, if the bag names it
};

/// Called repeatedly with the progress of reading a file. It may throw to end the reading.
using BagProgress = std::function<void(std::size_t done_B, std::size_t all_B)>;

/// Callbacks for the content of a bag, in file order. Views are valid until the callback returns.
struct BagVisitor {
  std::function<void(const BagConnection&)> connection;  ///< may be called repeatedly for one id
  std::function<void(std::uint32_t connection, Stamp recorded, Bytes message)> message;
  BagProgress progress = {};  ///< may be empty
};

/// Damage of a bag.
struct BagDamage {
  std::uint64_t bytes = 0;   ///< bytes of the file that belong to no complete record
  std::uint64_t chunks = 0;  ///< compressed chunks that could be unpacked only partly or not at all
  bool encrypted = false;    ///< the bag is encrypted and unreadable
  /// Unpacking and searching exceeded the UnpackBudget, so the bag was not read to its end.
  bool beyond_budget = false;
  std::string database = {};  ///< error message of SQLite for a damaged database
};

inline constexpr std::string_view kBagMagic = "#ROSBAG V2.0\n";
inline constexpr std::string_view kMcapMagic = "\x89MCAP0\r\n";
inline constexpr std::string_view kDatabaseMagic = "SQLite format 3";
inline constexpr std::string_view kZstdMagic = "\x28\xB5\x2F\xFD";

/// Reads a ROS 1 bag. If it is truncated, damaged or unclosed, reads all complete records. Reentrant.
BagDamage visit_bag(Bytes file, const BagVisitor& visitor);
/// As visit_bag(), for MCAP.
BagDamage visit_mcap(Bytes file, const BagVisitor& visitor);

/// As visit_bag(), for a ROS 2 database (.db3). The file is not copied into memory. For a file that is no database,
/// only damage is reported.
BagDamage visit_database(const std::filesystem::path& file, const BagVisitor& visitor);

/// Unpacks a bz2, lz4 or zstd chunk of at most kMaxChunkBytes. `whole` is set to whether the chunk was complete. A
/// truncated chunk gives the part before its end. A damaged chunk, or one that exceeds the budget, gives nothing.
std::vector<std::byte> unpack_chunk(std::string_view compression, Bytes packed, UnpackBudget& budget, bool& whole);
inline constexpr std::size_t kMaxChunkBytes = std::size_t{1} << 29U;

/// Converts a ROS time, rounded to microseconds.
Stamp ros_stamp(std::uint32_t seconds, std::uint32_t nanoseconds);

}  // namespace azimuth
