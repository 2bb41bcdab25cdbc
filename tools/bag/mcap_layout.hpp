#pragma once
// Common definitions for reading and writing MCAP (https://mcap.dev/spec). Internal to tools/bag.
//
// A file consists of kMcapMagic, a sequence of records, and kMcapMagic again. A record consists of the operation, the
// length of the content (64 bits) and the content. Chunks contain records.

#include <cstdint>

namespace azimuth {

enum class McapOp : std::uint8_t {
  header = 1,
  footer = 2,
  schema = 3,
  channel = 4,
  message = 5,
  chunk = 6,
  message_index = 7,
  chunk_index = 8,
  statistics = 11,
  summary_offset = 14,
  data_end = 15
};

}  // namespace azimuth
