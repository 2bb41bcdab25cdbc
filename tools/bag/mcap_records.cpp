// Reads MCAP. A record consists of an operation, a length and the content. Most records are in chunks.

#include <algorithm>
#include <map>
#include <set>
#include <zlib.h>

#include "tools/bag/bag_layout.hpp"
#include "tools/bag/bag_records.hpp"
#include "tools/bag/mcap_layout.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kRecordHead = 9;      // size of operation and length
constexpr std::size_t kLongestName = 1024;  // limit of a schema name, which each channel copies

/// Reads numbers and texts from the front of a byte sequence. After the sequence is exhausted, all values are empty.
class Content {
 public:
  explicit Content(Bytes bytes) : rest_(bytes) {}

  template <class Integer>
  Integer number() {
    return little_endian<Integer>(take(sizeof(Integer)));
  }
  std::string_view text() { return as_text(take(number<std::uint32_t>())); }
  Bytes take(std::uint64_t size) {
    is_sound_ = is_sound_ && size <= rest_.size();
    if (!is_sound_) return {};
    const Bytes front = rest_.first(static_cast<std::size_t>(size));
    rest_ = rest_.subspan(front.size());
    return front;
  }
  Bytes rest() const { return rest_; }
  bool is_sound() const { return is_sound_; }
  bool is_used_up() const { return is_sound_ && rest_.empty(); }

 private:
  Bytes rest_;
  bool is_sound_ = true;
};

struct McapRecord {
  McapOp op{};
  std::uint64_t size = 0;  ///< size of the content according to the record
  Bytes rest;              ///< the file from the content on

  bool is_whole() const { return size <= rest.size(); }
  Bytes content() const { return rest.first(static_cast<std::size_t>(std::min<std::uint64_t>(size, rest.size()))); }
};

// The record structures are views of the content. After damage, a record may begin at any byte, so that copies would
// take hours.
struct SchemaRecord {
  std::uint16_t id = 0;
  std::string_view name, encoding, definition;
};
std::optional<SchemaRecord> read_schema(Bytes content) {
  Content said(content);
  const SchemaRecord schema{said.number<std::uint16_t>(), said.text(), said.text(), said.text()};
  const bool has_names = schema.name.size() <= kLongestName && schema.encoding.size() <= kLongestName;
  return said.is_used_up() && schema.id != 0 && has_names ? std::optional(schema) : std::nullopt;
}

struct Channel {
  std::uint16_t id = 0, schema = 0;
  std::string_view topic, encoding, sender = {};
};

/// The value of `key` in the metadata of a channel, which are pairs of texts.
std::string_view said_of(Bytes pairs, std::string_view key) {
  for (Content said(pairs); said.is_sound() && !said.is_used_up();) {
    const std::string_view each = said.text(), value = said.text();
    if (said.is_sound() && each == key) return value;
  }
  return {};
}

std::optional<Channel> read_channel(Bytes content) {
  Content said(content);
  Channel channel{said.number<std::uint16_t>(), said.number<std::uint16_t>(), said.text(), said.text()};
  channel.sender = said_of(said.take(said.number<std::uint32_t>()), "callerid");  // in converted ROS 1 bags
  return said.is_used_up() ? std::optional(channel) : std::nullopt;
}

struct Message {
  std::uint16_t channel = 0;
  std::uint64_t recorded_ns = 0;
  Bytes data;
};
std::optional<Message> read_message(Bytes content) {
  Content said(content);
  Message message;
  message.channel = said.number<std::uint16_t>();
  said.number<std::uint32_t>();  // skips the sequence number

  message.recorded_ns = said.number<std::uint64_t>();
  said.number<std::uint64_t>();  // skips the time of publishing

  message.data = said.rest();
  return said.is_sound() ? std::optional(message) : std::nullopt;
}

struct Chunk {
  std::uint64_t unpacked_size = 0;
  std::uint32_t checksum = 0;  ///< checksum of the unpacked records; 0: none
  std::string_view compression;
  std::size_t head = 0;  ///< number of bytes before the records
  Bytes records;         ///< packed records; for a truncated chunk the available part
  bool is_whole = false;
};
/// Reads the head of a chunk. A chunk without a length, or a truncated one, extends to the end of the file.
std::optional<Chunk> read_chunk(const McapRecord& record) {
  const Bytes content = record.is_whole() ? record.content() : record.rest;
  Content said(content);
  const auto begin_ns = said.number<std::uint64_t>(), end_ns = said.number<std::uint64_t>();
  Chunk chunk;
  chunk.unpacked_size = said.number<std::uint64_t>();
  chunk.checksum = said.number<std::uint32_t>();
  chunk.compression = said.text();
  const auto size = said.number<std::uint64_t>();
  if (!said.is_sound() || begin_ns > end_ns || chunk.unpacked_size > kMaxChunkBytes) return std::nullopt;
  chunk.records = said.rest();
  chunk.head = content.size() - chunk.records.size();
  chunk.is_whole = record.is_whole() && size == chunk.records.size();
  return chunk.is_whole || !record.is_whole() ? std::optional(std::move(chunk)) : std::nullopt;
}

/// The ROS version of a channel; nothing for encodings that RosDefinition does not support.
std::optional<RosVersion> version_of(std::string_view message_encoding, std::string_view schema_encoding) {
  if (message_encoding == "cdr" && schema_encoding == "ros2msg") return RosVersion::two;
  if (message_encoding == "ros1" && schema_encoding == "ros1msg") return RosVersion::one;
  return std::nullopt;
}

/// A schema, kept as long as a channel may refer to it.
struct Schema {
  std::string name, encoding;
  SharedText definition;
  std::string checksum;
};

/// A checksum of a definition, since MCAP contains none. Equal texts have equal checksums.
std::string checksum_of_text(std::string_view text) {
  return std::to_string(text.size()) + '-' + std::to_string(std::hash<std::string_view>{}(text));
}

/// Iterates over records, including those in chunks.
class McapWalk {
 public:
  McapWalk(const BagVisitor& visitor, std::size_t file_B) : visitor_(visitor), budget_(file_B), file_B_(file_B) {}

  /// Reads records and returns the number of bytes that belong to no record. After invalid bytes, searches for the next
  /// record.
  std::uint64_t records(Bytes bytes, bool in_chunk) {
    std::uint64_t damaged = 0;
    bool is_lost = false;
    while (!bytes.empty() && !budget_.is_overdrawn()) {
      if (!in_chunk) tell_progress(bytes.size());
      const std::optional<McapRecord> record = record_at(bytes);
      std::size_t taken = 0;
      if (record && (!is_lost || is_surely_one(*record))) taken = take(*record, in_chunk);
      if (taken == 0 && !is_lost && as_text(bytes) == kMcapMagic) return damaged;
      is_lost = taken == 0;
      if (is_lost) {
        ++damaged;
        budget_.spend(work_of_looking_at(record));
      }
      bytes = bytes.subspan(std::max<std::size_t>(taken, 1));
    }
    return damaged;
  }

  BagDamage damage() const {
    BagDamage damage = damage_;
    damage.beyond_budget = budget_.is_overdrawn();
    return damage;
  }

 private:
  static std::optional<McapRecord> record_at(Bytes bytes) {
    if (bytes.size() < kRecordHead) return std::nullopt;
    Content said(bytes);
    McapRecord record;
    record.op = static_cast<McapOp>(said.number<std::uint8_t>());
    record.size = said.number<std::uint64_t>();
    record.rest = said.rest();
    return record.op == McapOp{} ? std::nullopt : std::optional(record);
  }

  /// Cost of testing a false record. For a channel, all of its metadata was read; for other records, only fields at
  /// fixed positions.
  static std::uint64_t work_of_looking_at(const std::optional<McapRecord>& record) {
    const bool was_read = record && record->op == McapOp::channel && record->is_whole();
    return kLookingForARecord_B + (was_read ? record->size : 0);
  }

  /// Stricter test for a record after damage: its content is valid, and another record or the end follows.
  bool is_surely_one(const McapRecord& record) const {
    if (!holds_what_it_should(record)) return false;
    const Bytes after = record.rest.subspan(record.content().size());
    if (after.empty()) return true;
    const std::optional<McapRecord> next = record_at(after);
    return next && next->is_whole() && next->op <= McapOp::data_end;
  }
  bool holds_what_it_should(const McapRecord& record) const {
    switch (record.op) {
      case McapOp::schema:
        return record.is_whole() && read_schema(record.content());
      case McapOp::channel:
        return record.is_whole() && read_channel(record.content());
      case McapOp::chunk:
        return read_chunk(record).has_value();
      case McapOp::message: {
        const auto message = record.is_whole() ? read_message(record.content()) : std::nullopt;
        return message && channels_.contains(message->channel);
      }
      default:
        return false;
    }
  }

  /// Reads a record and returns the number of consumed bytes; 0 if the record is incomplete or its content is invalid.
  std::size_t take(const McapRecord& record, bool in_chunk) {
    if (record.op == McapOp::chunk) return in_chunk ? 0 : take_chunk(record);
    if (!record.is_whole()) return 0;
    const Bytes content = record.content();
    bool is_sound = true;
    if (record.op == McapOp::schema) is_sound = take_schema(content);
    if (record.op == McapOp::channel) is_sound = take_channel(content);
    if (record.op == McapOp::message) is_sound = take_message(content);
    return is_sound ? kRecordHead + content.size() : 0;
  }

  bool take_schema(Bytes content) {
    const std::optional<SchemaRecord> schema = read_schema(content);
    if (schema)
      schemas_.insert_or_assign(
          schema->id, Schema{std::string(schema->name), std::string(schema->encoding), std::string(schema->definition),
                             checksum_of_text(schema->definition)});
    return schema.has_value();
  }

  bool take_channel(Bytes content) {
    const std::optional<Channel> channel = read_channel(content);
    if (!channel) return false;
    channels_.insert(channel->id);
    const auto found = schemas_.find(channel->schema);
    const Schema schema = found != schemas_.end() ? found->second : Schema{};
    const std::string encoding(channel->encoding);
    const std::optional<RosVersion> version = version_of(encoding, schema.encoding);
    std::string type = without_msg(schema.name);
    if (!version) type += " (" + encoding + (schema.encoding.empty() ? "" : ", " + schema.encoding) + ')';
    visitor_.connection({channel->id, std::string(channel->topic), type, version ? schema.definition : SharedText(),
                         version ? schema.checksum : "", version.value_or(RosVersion::two),
                         std::string(channel->sender)});
    return true;
  }

  bool take_message(Bytes content) {
    const std::optional<Message> message = read_message(content);
    if (!message) return false;
    visitor_.message(message->channel, stamp_of_ns(message->recorded_ns), message->data);
    return true;
  }

  static Stamp stamp_of_ns(std::uint64_t ns) { return stamp_from_us(static_cast<std::int64_t>((ns + 500) / 1000)); }

  /// Reads a chunk. Only the head of an uncompressed chunk is consumed and its records are read in place, so that the
  /// chunk may be truncated. A compressed chunk is unpacked as far as possible, unless its checksum is wrong.
  std::size_t take_chunk(const McapRecord& record) {
    const std::optional<Chunk> chunk = read_chunk(record);
    if (!chunk) return 0;
    if (chunk->compression.empty()) return kRecordHead + chunk->head;
    bool unpacked = false;
    const std::vector<std::byte> bytes = unpack_chunk(chunk->compression, chunk->records, budget_, unpacked);
    const bool is_right = !unpacked || chunk->checksum == 0 || checksum_of(bytes) == chunk->checksum;
    const bool is_sound = is_right && records(bytes, true) == 0;
    if (!chunk->is_whole || !unpacked || !is_sound) ++damage_.chunks;
    return kRecordHead + record.content().size();
  }

  static std::uint32_t checksum_of(Bytes bytes) {
    return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
  }

  void tell_progress(std::size_t left_B) {
    if (!visitor_.progress || told_B_ - left_B < bag::kProgress_B) return;
    told_B_ = left_B;
    visitor_.progress(file_B_ - left_B, file_B_);
  }

  const BagVisitor& visitor_;
  UnpackBudget budget_;
  std::size_t file_B_, told_B_ = file_B_;  // told_B_: bytes left at the last progress call
  BagDamage damage_;
  std::map<std::uint16_t, Schema> schemas_;
  std::set<std::uint16_t> channels_;  // channels already reported to the visitor
};

}  // namespace

BagDamage visit_mcap(Bytes file, const BagVisitor& visitor) {
  McapWalk walk(visitor, file.size());
  const std::uint64_t bytes = walk.records(file.subspan(std::min(kMcapMagic.size(), file.size())), false);
  BagDamage damage = walk.damage();
  damage.bytes = bytes;
  return damage;
}

}  // namespace azimuth
