#pragma once
// Writes ROS 1 bags (format 2.0) to memory, with the index that the readers of ROS need.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.hpp"
#include "tools/bag/bag_records.hpp"

namespace azimuth {

/// Time of ROS 1: since the epoch, until the year 2106.
struct BagTime {
  std::uint32_t seconds = 0;
  std::uint32_t nanoseconds = 0;  ///< fraction of a second
  friend bool operator<(const BagTime& a, const BagTime& b) {
    return a.seconds != b.seconds ? a.seconds < b.seconds : a.nanoseconds < b.nanoseconds;
  }
};

/// Makes one bag with uncompressed chunks. The whole bag is in memory. The same calls give the same bytes.
///
/// Thread contract: thread-bound.
class BagWriter {
 public:
  BagWriter();

  /// Adds a connection and returns its number for message(). `connection.id` is ignored.
  std::uint32_t connect(BagConnection connection);
  /// Adds a message. Messages may have any order of time, but readers are faster if they are sorted.
  void message(std::uint32_t connection, BagTime time, std::string_view bytes);
  /// Returns the whole bag. Must be called once, at the end.
  std::string finish();

  /// A chunk is closed after the message with which it reaches this size.
  static constexpr std::size_t kChunkBytes = std::size_t{1} << 20U;

 private:
  struct Entry {
    BagTime time;
    std::uint32_t offset = 0;  // position of the record in its chunk
  };
  struct Chunk {
    std::uint64_t position = 0;  // position in the file
    BagTime first, last;
    std::map<std::uint32_t, std::uint32_t> messages;  // number of messages by connection
  };

  void close_chunk();
  void write_head(std::uint64_t index_position);
  std::string connection_record(const BagConnection& connection) const;

  LittleBytes file_, chunk_;
  std::map<std::uint32_t, std::vector<Entry>> entries_;  // messages of the present chunk, by connection
  std::vector<BagConnection> connections_;
  std::vector<bool> introduced_;  // by connection: a chunk already contains its record
  std::vector<Chunk> chunks_;
};

}  // namespace azimuth
