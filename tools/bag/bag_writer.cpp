#include "tools/bag/bag_writer.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "tools/bag/bag_layout.hpp"

namespace azimuth {
namespace {

using bag::Op;
namespace field = bag::field;

/// Padded size of the bag header record, header and data, so that it can be rewritten in place.
constexpr std::size_t kHeadBytes = 4096;
constexpr std::uint32_t kIndexVersion = 1;

/// Builds a header or the data of a connection record.
class FieldsOut {
 public:
  FieldsOut() = default;
  explicit FieldsOut(Op op) { add(field::kOp, LittleBytes().put(static_cast<std::uint8_t>(op))); }

  FieldsOut& add(std::string_view name, std::string_view value) {
    bytes_.put(static_cast<std::uint32_t>(name.size() + 1 + value.size())).raw(name).raw("=").raw(value);
    return *this;
  }
  FieldsOut& add(std::string_view name, const LittleBytes& value) { return add(name, value.bytes()); }
  FieldsOut& add(std::string_view name, std::uint32_t value) { return add(name, LittleBytes().put(value)); }
  FieldsOut& add(std::string_view name, std::uint64_t value) { return add(name, LittleBytes().put(value)); }
  FieldsOut& add(std::string_view name, BagTime value) {
    return add(name, LittleBytes().put(value.seconds).put(value.nanoseconds));
  }
  const std::string& bytes() const { return bytes_.bytes(); }

 private:
  LittleBytes bytes_;
};

std::string record(const FieldsOut& header, std::string_view data) {
  return LittleBytes().text(header.bytes()).text(data).take();
}

}  // namespace

BagWriter::BagWriter() {
  file_.raw(kBagMagic);
  write_head(0);
}

std::uint32_t BagWriter::connect(BagConnection connection) {
  connection.id = static_cast<std::uint32_t>(connections_.size());
  connections_.push_back(std::move(connection));
  introduced_.push_back(false);
  return connections_.back().id;
}

void BagWriter::message(std::uint32_t connection, BagTime time, std::string_view bytes) {
  assert(connection < connections_.size());
  if (!introduced_[connection]) {
    chunk_.raw(connection_record(connections_[connection]));
    introduced_[connection] = true;
  }
  entries_[connection].push_back({time, static_cast<std::uint32_t>(chunk_.size())});
  chunk_.raw(record(FieldsOut(Op::message).add(field::kConnection, connection).add(field::kTime, time), bytes));
  if (chunk_.size() >= kChunkBytes) close_chunk();
}

/// Writes the chunk, then an index record for each of its connections.
void BagWriter::close_chunk() {
  if (entries_.empty()) return;
  Chunk chunk{.position = file_.size(),
              .first = entries_.begin()->second.front().time,
              .last = entries_.begin()->second.front().time,
              .messages = {}};
  const FieldsOut header = FieldsOut(Op::chunk)
                               .add(field::kCompression, "none")
                               .add(field::kSize, static_cast<std::uint32_t>(chunk_.size()));
  file_.raw(record(header, chunk_.take()));
  for (const auto& [connection, entries] : entries_) {
    LittleBytes index;
    for (const Entry& entry : entries) {
      index.put(entry.time.seconds).put(entry.time.nanoseconds).put(entry.offset);
      chunk.first = std::min(chunk.first, entry.time);
      chunk.last = std::max(chunk.last, entry.time);
    }
    const auto count = static_cast<std::uint32_t>(entries.size());
    chunk.messages[connection] = count;
    file_.raw(record(FieldsOut(Op::index)
                         .add(field::kVersion, kIndexVersion)
                         .add(field::kConnection, connection)
                         .add(field::kCount, count),
                     index.bytes()));
  }
  chunks_.push_back(std::move(chunk));
  entries_.clear();
}

std::string BagWriter::finish() {
  close_chunk();
  const std::uint64_t index_position = file_.size();
  for (const BagConnection& connection : connections_) file_.raw(connection_record(connection));
  for (const Chunk& chunk : chunks_) {
    LittleBytes counts;
    for (const auto& [connection, count] : chunk.messages) counts.put(connection).put(count);
    file_.raw(record(FieldsOut(Op::chunk_info)
                         .add(field::kVersion, kIndexVersion)
                         .add(field::kChunkPosition, chunk.position)
                         .add(field::kStartTime, chunk.first)
                         .add(field::kEndTime, chunk.last)
                         .add(field::kCount, static_cast<std::uint32_t>(chunk.messages.size())),
                     counts.bytes()));
  }
  std::string whole = file_.take();
  write_head(index_position);  // rewrites the bag header with the known position
  std::ranges::copy(file_.take(), whole.begin() + static_cast<std::ptrdiff_t>(kBagMagic.size()));
  return whole;
}

void BagWriter::write_head(std::uint64_t index_position) {
  const FieldsOut header = FieldsOut(Op::bag)
                               .add(field::kIndexPosition, index_position)
                               .add(field::kConnectionCount, static_cast<std::uint32_t>(connections_.size()))
                               .add(field::kChunkCount, static_cast<std::uint32_t>(chunks_.size()));
  file_.raw(record(header, std::string(kHeadBytes - header.bytes().size(), ' ')));
}

std::string BagWriter::connection_record(const BagConnection& connection) const {
  const FieldsOut header =
      FieldsOut(Op::connection).add(field::kConnection, connection.id).add(field::kTopic, connection.topic);
  return record(header, FieldsOut()
                            .add(field::kTopic, connection.topic)
                            .add(field::kType, connection.type)
                            .add(field::kChecksum, connection.checksum)
                            .add(field::kDefinition, connection.definition)
                            .bytes());
}

}  // namespace azimuth
