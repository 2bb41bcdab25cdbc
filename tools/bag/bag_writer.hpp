#pragma once
// Bags of ROS 1 (format 2.0), as bytes: what bag_records.hpp reads, with the index that ROS's own readers need.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/little_bytes.hpp"
#include "tools/bag/bag_records.hpp"

namespace azimuth {

/// As ROS 1 counts: since the epoch, until 2106.
struct BagTime {
  std::uint32_t seconds = 0;
  std::uint32_t nanoseconds = 0;  ///< below a second
  friend bool operator<(const BagTime& a, const BagTime& b) {
    return a.seconds != b.seconds ? a.seconds < b.seconds : a.nanoseconds < b.nanoseconds;
  }
};

/// Makes one bag, in chunks that are not compressed. All of it is in memory, and the same calls give the same bytes.
///
/// Thread contract: thread-bound.
class BagWriter {
 public:
  BagWriter();

  /// Returns its number for message(); `connection.id` is not looked at.
  std::uint32_t connect(BagConnection connection);
  /// In any order of time, but readers go faster through messages that are in theirs.
  void message(std::uint32_t connection, BagTime time, std::string_view bytes);
  /// The whole bag. To be called once, at the end.
  std::string finish();

  /// A chunk is closed by the message that makes it so large.
  static constexpr std::size_t kChunkBytes = std::size_t{1} << 20U;

 private:
  struct Entry {
    BagTime time;
    std::uint32_t offset = 0;  // of the record among those of its chunk
  };
  struct Chunk {
    std::uint64_t position = 0;  // in the file
    BagTime first, last;
    std::map<std::uint32_t, std::uint32_t> messages;  // of each connection
  };

  void close_chunk();
  void write_head(std::uint64_t index_position);
  std::string connection_record(const BagConnection& connection) const;

  LittleBytes file_, chunk_;
  std::map<std::uint32_t, std::vector<Entry>> entries_;  // of the chunk, by connection
  std::vector<BagConnection> connections_;
  std::vector<bool> introduced_;  // it stands in some chunk
  std::vector<Chunk> chunks_;
};

}  // namespace azimuth
