#pragma once
// What reading and writing bags of ROS 1 have in common. Internal to tools/bag.
//
// After the line kBagMagic a bag is a sequence of records: the length of the header in 32 bits, header, length of the
// data, data. A header is a sequence of fields, each with its length before it: `name=value`. Chunks hold records of
// their own.

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace azimuth::bag {

/// Of a file, after which it is told again how far reading it is.
inline constexpr std::size_t kProgress_B = std::size_t{1} << 16U;

/// The field `op` of each header.
enum class Op : std::uint8_t { message = 2, bag = 3, index = 4, chunk = 5, chunk_info = 6, connection = 7 };

namespace field {

inline constexpr std::string_view kOp = "op";
inline constexpr std::string_view kConnection = "conn";
inline constexpr std::string_view kTime = "time";
// Of a chunk.
inline constexpr std::string_view kCompression = "compression";
inline constexpr std::string_view kSize = "size";
// Of a connection; but for the first they are in its data.
inline constexpr std::string_view kTopic = "topic";
inline constexpr std::string_view kType = "type";
inline constexpr std::string_view kChecksum = "md5sum";
inline constexpr std::string_view kDefinition = "message_definition";
inline constexpr std::string_view kSender = "callerid";
// Of the bag.
inline constexpr std::string_view kEncryptor = "encryptor";
inline constexpr std::string_view kIndexPosition = "index_pos";
inline constexpr std::string_view kConnectionCount = "conn_count";
inline constexpr std::string_view kChunkCount = "chunk_count";
// Of indices and of what is said of chunks at the end.
inline constexpr std::string_view kVersion = "ver";
inline constexpr std::string_view kCount = "count";
inline constexpr std::string_view kChunkPosition = "chunk_pos";
inline constexpr std::string_view kStartTime = "start_time";
inline constexpr std::string_view kEndTime = "end_time";

}  // namespace field

}  // namespace azimuth::bag
