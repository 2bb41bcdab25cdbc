#pragma once
// Common definitions for reading and writing ROS 1 bags. Internal to tools/bag.
//
// After the line kBagMagic, a bag is a sequence of records. A record consists of the header's length (32 bits), the
// header, the data's length (32 bits) and the data. A header is a sequence of fields `name=value`, each preceded by its
// length. Chunks contain records.

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace azimuth::bag {

/// Number of bytes of a file between two calls of the progress callback.
inline constexpr std::size_t kProgress_B = std::size_t{1} << 16U;

/// The field `op` of each header.
enum class Op : std::uint8_t { message = 2, bag = 3, index = 4, chunk = 5, chunk_info = 6, connection = 7 };

namespace field {

inline constexpr std::string_view kOp = "op";
inline constexpr std::string_view kConnection = "conn";
inline constexpr std::string_view kTime = "time";
// Fields of a chunk.
inline constexpr std::string_view kCompression = "compression";
inline constexpr std::string_view kSize = "size";
// Fields of a connection. All except kTopic are in the data of the record.
inline constexpr std::string_view kTopic = "topic";
inline constexpr std::string_view kType = "type";
inline constexpr std::string_view kChecksum = "md5sum";
inline constexpr std::string_view kDefinition = "message_definition";
inline constexpr std::string_view kSender = "callerid";
// Fields of the bag header record.
inline constexpr std::string_view kEncryptor = "encryptor";
inline constexpr std::string_view kIndexPosition = "index_pos";
inline constexpr std::string_view kConnectionCount = "conn_count";
inline constexpr std::string_view kChunkCount = "chunk_count";
// Fields of index records and of chunk information records.
inline constexpr std::string_view kVersion = "ver";
inline constexpr std::string_view kCount = "count";
inline constexpr std::string_view kChunkPosition = "chunk_pos";
inline constexpr std::string_view kStartTime = "start_time";
inline constexpr std::string_view kEndTime = "end_time";

}  // namespace field

}  // namespace azimuth::bag
