#pragma once
// Writes MCAP files (https://mcap.dev/spec, version 0) to memory: messages in uncompressed chunks, with the index, the
// statistics and the checksums that other readers need. Attachments and metadata records are not supported.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.hpp"

namespace azimuth {

/// Makes one file. The whole file is in memory. The same calls give the same bytes.
///
/// Thread contract: thread-bound.
class McapWriter {
 public:
  McapWriter(std::string_view profile, std::string_view library);

  /// Adds a message definition and returns its number for add_channel().
  std::uint16_t add_schema(std::string_view name, std::string_view encoding, std::string_view definition);
  using Metadata = std::map<std::string, std::string>;
  /// Adds a channel and returns its number for message(). All schemas and channels must precede the first message.
  std::uint16_t add_channel(std::uint16_t schema, std::string_view topic, std::string_view encoding,
                            const Metadata& metadata);
  /// Adds a message. `time_ns` is the time since the epoch or since the start of a recording.
  void message(std::uint16_t channel, std::uint64_t time_ns, std::string_view bytes);
  /// Returns the whole file. Must be called once, at the end.
  std::string finish();

  /// A chunk is closed after the message with which it reaches this size.
  static constexpr std::size_t kChunkBytes = std::size_t{1} << 20U;

 private:
  struct Entry {
    std::uint64_t time_ns = 0;
    std::uint64_t offset = 0;  // position of the record in its chunk
  };
  struct Span {
    std::uint64_t first_ns = 0, last_ns = 0;
    bool any = false;

    void take(std::uint64_t time_ns);
  };
  struct Chunk {
    Span span;
    std::uint64_t position = 0, size = 0;                 // position and size of the chunk's record in the file
    std::uint64_t records_size = 0;                       // size of the records in the chunk
    std::map<std::uint16_t, std::uint64_t> index_places;  // position of the message index by channel
    std::uint64_t index_size = 0;
  };
  struct Group {
    std::uint8_t op = 0;
    std::uint64_t begin = 0, end = 0;
  };

  void close_chunk();
  void write_index(Chunk& chunk);
  void write_summary();
  void write_statistics();
  void write_chunk_index(const Chunk& chunk);

  LittleBytes file_, chunk_;
  Span chunk_span_, span_;
  std::map<std::uint16_t, std::vector<Entry>> entries_;    // messages of the present chunk, by channel
  std::vector<std::string> schemas_, channels_;            // contents of their records
  std::map<std::uint16_t, std::uint64_t> message_counts_;  // numbers of messages by channel
  std::vector<Chunk> chunks_;
};

}  // namespace azimuth
