#include "tools/bag/mcap_writer.hpp"

#include <algorithm>
#include <cassert>
#include <utility>
#include <zlib.h>

#include "tools/bag/bag_records.hpp"
#include "tools/bag/mcap_layout.hpp"

namespace azimuth {
namespace {

constexpr std::string_view kNotCompressed = "";

std::uint32_t crc(std::string_view bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

void write(LittleBytes& out, McapOp op, std::string_view content) {
  out.put(static_cast<std::uint8_t>(op)).put(static_cast<std::uint64_t>(content.size())).raw(content);
}

/// Serialises a map of numbers: its size in bytes, then each pair.
std::string map_bytes(const std::map<std::uint16_t, std::uint64_t>& numbers) {
  LittleBytes pairs;
  for (const auto& [key, value] : numbers) pairs.put(key).put(value);
  return LittleBytes().text(pairs.bytes()).take();
}

}  // namespace

void McapWriter::Span::take(std::uint64_t time_ns) {
  first_ns = any ? std::min(first_ns, time_ns) : time_ns;
  last_ns = any ? std::max(last_ns, time_ns) : time_ns;
  any = true;
}

McapWriter::McapWriter(std::string_view profile, std::string_view library) {
  file_.raw(kMcapMagic);
  write(file_, McapOp::header, LittleBytes().text(profile).text(library).bytes());
}

std::uint16_t McapWriter::add_schema(std::string_view name, std::string_view encoding, std::string_view definition) {
  const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);  // 0 means no schema
  schemas_.push_back(LittleBytes().put(id).text(name).text(encoding).text(definition).bytes());
  write(file_, McapOp::schema, schemas_.back());
  return id;
}

std::uint16_t McapWriter::add_channel(std::uint16_t schema, std::string_view topic, std::string_view encoding,
                                      const Metadata& metadata) {
  assert(schema <= schemas_.size());
  const auto id = static_cast<std::uint16_t>(channels_.size());
  LittleBytes pairs;
  for (const auto& [key, value] : metadata) pairs.text(key).text(value);
  channels_.push_back(LittleBytes().put(id).put(schema).text(topic).text(encoding).text(pairs.bytes()).bytes());
  write(file_, McapOp::channel, channels_.back());
  return id;
}

void McapWriter::message(std::uint16_t channel, std::uint64_t time_ns, std::string_view bytes) {
  assert(channel < channels_.size());
  std::uint64_t& count = message_counts_[channel];
  entries_[channel].push_back({time_ns, chunk_.size()});
  LittleBytes content;
  content.put(channel).put(static_cast<std::uint32_t>(count)).put(time_ns).put(time_ns).raw(bytes);
  write(chunk_, McapOp::message, content.bytes());
  ++count;
  chunk_span_.take(time_ns);
  span_.take(time_ns);
  if (chunk_.size() >= kChunkBytes) close_chunk();
}

void McapWriter::close_chunk() {
  if (entries_.empty()) return;
  const std::string records = chunk_.take();
  Chunk chunk{.span = std::exchange(chunk_span_, {}),
              .position = file_.size(),
              .size = 0,
              .records_size = records.size(),
              .index_places = {},
              .index_size = 0};
  LittleBytes content;
  content.put(chunk.span.first_ns).put(chunk.span.last_ns).put(chunk.records_size).put(crc(records));
  content.text(kNotCompressed).put(chunk.records_size).raw(records);
  write(file_, McapOp::chunk, content.bytes());
  chunk.size = file_.size() - chunk.position;
  write_index(chunk);
  chunks_.push_back(std::move(chunk));
}

/// Writes for each channel the positions of its messages in the chunk.
void McapWriter::write_index(Chunk& chunk) {
  const std::uint64_t begin = file_.size();
  for (const auto& [channel, entries] : entries_) {
    chunk.index_places[channel] = file_.size();
    LittleBytes places;
    for (const Entry& entry : entries) places.put(entry.time_ns).put(entry.offset);
    write(file_, McapOp::message_index, LittleBytes().put(channel).text(places.bytes()).bytes());
  }
  chunk.index_size = file_.size() - begin;
  entries_.clear();
}

std::string McapWriter::finish() {
  close_chunk();
  write(file_, McapOp::data_end, LittleBytes().put(crc(file_.bytes())).bytes());
  write_summary();
  file_.raw(kMcapMagic);
  return file_.take();
}

/// Writes schemas, channels, statistics and the chunk index, then the positions of these groups, then the footer. The
/// checksum in the footer covers the summary and the footer up to the checksum.
void McapWriter::write_summary() {
  const std::uint64_t begin = file_.size();
  std::vector<Group> groups;
  const auto group = [&](McapOp op, const auto& write_all) {
    const std::uint64_t from = file_.size();
    write_all();
    if (file_.size() > from) groups.push_back({static_cast<std::uint8_t>(op), from, file_.size()});
  };
  group(McapOp::schema, [&] {
    for (const std::string& schema : schemas_) write(file_, McapOp::schema, schema);
  });
  group(McapOp::channel, [&] {
    for (const std::string& channel : channels_) write(file_, McapOp::channel, channel);
  });
  group(McapOp::statistics, [&] { write_statistics(); });
  group(McapOp::chunk_index, [&] {
    for (const Chunk& chunk : chunks_) write_chunk_index(chunk);
  });
  const std::uint64_t offsets = file_.size();
  for (const Group& each : groups)
    write(file_, McapOp::summary_offset, LittleBytes().put(each.op).put(each.begin).put(each.end - each.begin).bytes());
  constexpr std::uint64_t kFooterSize = 8 + 8 + 4;
  file_.put(static_cast<std::uint8_t>(McapOp::footer)).put(kFooterSize).put(begin).put(offsets);
  file_.put(crc(std::string_view(file_.bytes()).substr(static_cast<std::size_t>(begin))));
}

void McapWriter::write_statistics() {
  std::uint64_t messages = 0;
  for (const auto& [channel, count] : message_counts_) messages += count;
  constexpr std::uint32_t kAttachments = 0, kMetadata = 0;
  LittleBytes content;
  content.put(messages).put(static_cast<std::uint16_t>(schemas_.size()));
  content.put(static_cast<std::uint32_t>(channels_.size())).put(kAttachments).put(kMetadata);
  content.put(static_cast<std::uint32_t>(chunks_.size())).put(span_.first_ns).put(span_.last_ns);
  content.raw(map_bytes(message_counts_));
  write(file_, McapOp::statistics, content.bytes());
}

void McapWriter::write_chunk_index(const Chunk& chunk) {
  LittleBytes content;
  content.put(chunk.span.first_ns).put(chunk.span.last_ns).put(chunk.position).put(chunk.size);
  content.raw(map_bytes(chunk.index_places)).put(chunk.index_size);
  content.text(kNotCompressed).put(chunk.records_size).put(chunk.records_size);
  write(file_, McapOp::chunk_index, content.bytes());
}

}  // namespace azimuth
