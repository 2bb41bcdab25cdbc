#pragma once
// MCAP files (https://mcap.dev/spec, version 0), as bytes: messages in chunks that are not compressed, with index,
// statistics and checksums, which readers need that bag_records.hpp does not know. Only what is needed for that is
// written: no attachments, no metadata.

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/little_bytes.hpp"

namespace azimuth {

/// Makes one file. All of it is in memory, and the same calls give the same bytes.
///
/// Thread contract: thread-bound.
class McapWriter {
 public:
  McapWriter(std::string_view profile, std::string_view library);

  /// What messages are made of. Returns its number for add_channel().
  std::uint16_t add_schema(std::string_view name, std::string_view encoding, std::string_view definition);
  using Metadata = std::map<std::string, std::string>;
  /// Returns its number for message(). Schemas and channels come before the first message.
  std::uint16_t add_channel(std::uint16_t schema, std::string_view topic, std::string_view encoding,
                            const Metadata& metadata);
  /// `time_ns` is since the epoch, or since the start of a recording.
  void message(std::uint16_t channel, std::uint64_t time_ns, std::string_view bytes);
  /// The whole file. To be called once, at the end.
  std::string finish();

  /// A chunk is closed by the message that makes it so large.
  static constexpr std::size_t kChunkBytes = std::size_t{1} << 20U;

 private:
  struct Entry {
    std::uint64_t time_ns = 0;
    std::uint64_t offset = 0;  // of the record among those of its chunk
  };
  struct Span {
    std::uint64_t first_ns = 0, last_ns = 0;
    bool any = false;

    void take(std::uint64_t time_ns);
  };
  struct Chunk {
    Span span;
    std::uint64_t position = 0, size = 0;                 // of its record in the file
    std::uint64_t records_size = 0;                       // of those in it
    std::map<std::uint16_t, std::uint64_t> index_places;  // of each channel
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
  std::map<std::uint16_t, std::vector<Entry>> entries_;    // of the chunk, by channel
  std::vector<std::string> schemas_, channels_;            // contents of their records
  std::map<std::uint16_t, std::uint64_t> message_counts_;  // by channel
  std::vector<Chunk> chunks_;
};

}  // namespace azimuth
