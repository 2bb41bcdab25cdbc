#pragma once
// What reading and writing MCAP (https://mcap.dev/spec) have in common. Internal to tools/bag.
//
// After kMcapMagic a file is a sequence of records, and kMcapMagic again: the operation, the length of the content in
// 64 bits, the content. Chunks hold records of their own.

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
