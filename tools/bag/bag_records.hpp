#pragma once
// The formats of bags, on bytes: that of ROS 1 (2.0), and MCAP, which ROS 2 records. Libraries that read them need an
// index at the end, which a recording that was cut short has not, and trust every length; here any bytes are safe, and
// what is whole is found wherever it lies. Those in SQLite are read by SQLite.

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
#include "tools/bag/unpack_budget.hpp"

namespace azimuth {

/// A text that is there once, however many have it: one schema of MCAP is that of any number of channels.
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

/// What a publisher said of its messages.
struct BagConnection {
  std::uint32_t id = 0;
  std::string topic;
  std::string type;       ///< sensor_msgs/Image, in ROS 2 as well; what is not ROS has its encoding in brackets
  SharedText definition;  ///< what it is made of, for RosDefinition
  std::string checksum;   ///< of the definition
  RosVersion version = RosVersion::one;
  std::string sender = {};  ///< the node that sent them, where the bag says so
};

/// Told from time to time how far the reading of a file is; what it throws ends that.
using BagProgress = std::function<void(std::size_t done_B, std::size_t all_B)>;

/// Told of what a bag holds, in the order in which it lies there; views are valid until the call returns.
struct BagVisitor {
  std::function<void(const BagConnection&)> connection;  ///< perhaps more than once
  std::function<void(std::uint32_t connection, Stamp recorded, Bytes message)> message;
  BagProgress progress = {};  ///< may be empty
};

/// What was wrong with a bag.
struct BagDamage {
  std::uint64_t bytes = 0;   ///< of the file, in no whole record
  std::uint64_t chunks = 0;  ///< compressed parts that could be unpacked only to some place, or not at all
  bool encrypted = false;    ///< nothing in it can be read
  bool beyond_budget =
      false;  ///< unpacking and searching it is more than an UnpackBudget allows: it was not read to its end
  std::string database = {};  ///< what SQLite says of one that is damaged
};

inline constexpr std::string_view kBagMagic = "#ROSBAG V2.0\n";
inline constexpr std::string_view kMcapMagic = "\x89MCAP0\r\n";
inline constexpr std::string_view kDatabaseMagic = "SQLite format 3";
inline constexpr std::string_view kZstdMagic = "\x28\xB5\x2F\xFD";

/// Walks all of a bag; of one that is cut, damaged or was never closed, all that is whole. Reentrant.
BagDamage visit_bag(Bytes file, const BagVisitor& visitor);
/// The same of MCAP.
BagDamage visit_mcap(Bytes file, const BagVisitor& visitor);

/// The same of a database of ROS 2 (.db3), which is not copied into memory. A file that is none has only damage.
BagDamage visit_database(const std::filesystem::path& file, const BagVisitor& visitor);

/// Unpacks a chunk, bz2, lz4 or zstd; `whole` says whether it was all there. Of one that is cut, what is before that;
/// of one that is damaged, or overdraws the budget, nothing. At most kMaxChunkBytes.
std::vector<std::byte> unpack_chunk(std::string_view compression, Bytes packed, UnpackBudget& budget, bool& whole);
inline constexpr std::size_t kMaxChunkBytes = std::size_t{1} << 29U;

/// Seconds and nanoseconds as ROS counts them, to the nearest microsecond.
Stamp ros_stamp(std::uint32_t seconds, std::uint32_t nanoseconds);

}  // namespace azimuth
