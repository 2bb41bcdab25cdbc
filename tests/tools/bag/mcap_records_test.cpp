#include <algorithm>
#include <gtest/gtest.h>
#include <lz4frame.h>
#include <span>
#include <vector>
#include <zlib.h>
#include <zstd.h>

#include "tests/support/cpu_time.hpp"
#include "tests/tools/bag/seen_in_bag.hpp"
#include "tests/tools/import/ros2_messages.hpp"
#include "tools/bag/bag_records.hpp"

namespace azimuth::test {
namespace {

const RosType kWords{"std_msgs/msg/String", "string data\n"};

SeenInBag visited(const std::string& file) { return seen_in(file, visit_mcap); }

const std::string kTopic = mcap_schema(1, kWords) + mcap_channel(7, 1, "/a");

/// Ten messages of different lengths; `ends` receives the offset at which each one ends.
std::string ten_in_mcap(std::vector<std::size_t>* ends = nullptr) {
  std::string records = kTopic;
  for (int i = 0; i < 10; ++i) {
    records += mcap_message(7, i, std::string(static_cast<std::size_t>(i * i), static_cast<char>('a' + i)));
    if (ends != nullptr) ends->push_back(records.size());
  }
  return records;
}

std::string zstd_of(const std::string& text) {
  std::string packed(ZSTD_compressBound(text.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), text.data(), text.size(), 3));
  return packed;
}
std::string lz4_of(const std::string& text) {
  std::string packed(LZ4F_compressFrameBound(text.size(), nullptr), '\0');
  packed.resize(LZ4F_compressFrame(packed.data(), packed.size(), text.data(), text.size(), nullptr));
  return packed;
}
std::uint32_t crc_of(const std::string& text) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(text.data()), text.size()));
}

TEST(McapRecords, ABombIsLeftAloneAndSaidToBeOne) {
  const std::string zeros(40'000'000, '\0');
  for (const auto& [name, packed] : {std::pair{"zstd", zstd_of(zeros)}, std::pair{"lz4", lz4_of(zeros)}}) {
    const std::string chunk = mcap_chunk(zeros, name, packed);
    const SeenInBag seen = visited(kMcapBegin + (chunk + chunk + chunk + chunk + chunk + chunk) + ten_in_mcap());
    EXPECT_TRUE(seen.damage.beyond_budget) << name;
    EXPECT_TRUE(seen.messages.empty()) << name;
  }
}

/// The beginning of a schema's record, up to its definition, whose length is given as `after` bytes.
std::string schema_begin(std::size_t after) {
  const std::string before = mcap_u16(1) + mcap_text("a/B") + mcap_text("ros2msg");
  return '\3' + mcap_u64(before.size() + 4 + after) + before + mcap_u32(static_cast<std::uint32_t>(after));
}

/// In a damaged file each byte may begin a record. Here 16,000 schemas begin; each one contains the rest of the file.
TEST(McapRecords, SchemasWithinSchemasAreNoWork) {
  constexpr std::size_t kSchemas = 16'000, kRest = 1'000'000;
  std::string schemas;
  for (std::size_t i = kSchemas; i-- > 0;) schemas += schema_begin(i * schema_begin(0).size() + kRest);
  const std::string file = kMcapBegin + "damage" + schemas + std::string(kRest, 'x') + "no record";
  const double begin_s = cpu_time_s();
  const SeenInBag seen = visited(file);
  EXPECT_LT(cpu_time_s() - begin_s, 1.0);
  EXPECT_GT(seen.damage.bytes, 1'000'000u);
}

/// The beginning of a channel's record, up to its metadata, which has `after` bytes and begins with a key of `key`
/// bytes.
std::string channel_begin(std::size_t after, std::size_t key) {
  const std::string before = mcap_u16(1) + mcap_u16(1) + mcap_text("/a") + mcap_text("cdr");
  return '\4' + mcap_u64(before.size() + 4 + after) + before + mcap_u32(static_cast<std::uint32_t>(after)) +
         mcap_u32(static_cast<std::uint32_t>(key));
}

/// Here 4000 channels begin, each of which contains the rest of the file. The reader must go through the whole metadata
/// of a channel to see that it is malformed.
TEST(McapRecords, ChannelsWithinChannelsAreNoWork) {
  constexpr std::size_t kRest = 4'000'000;  // metadata of empty texts
  const std::size_t begin = channel_begin(0, 0).size();
  std::string channels;
  for (std::size_t i = 4000; i-- > 0;) channels += channel_begin(4 + i * begin + kRest - 1, i == 0 ? 0 : begin - 4);
  const std::string file = kMcapBegin + "damage" + channels + std::string(kRest, '\0') + "no record";
  const double begin_s = cpu_time_s();
  EXPECT_TRUE(visited(file).damage.beyond_budget);
  EXPECT_LT(cpu_time_s() - begin_s, 2.0);
}

/// A chunk of a few kilobytes unpacks to 20 MB. The search for records in them costs more than the unpacking.
TEST(McapRecords, SearchingAPackIsWorkToo) {
  const std::string nothing(20'000'000, '\1');
  const SeenInBag seen = visited(kMcapBegin + mcap_chunk(nothing, "zstd", zstd_of(nothing)) + ten_in_mcap());
  EXPECT_TRUE(seen.damage.beyond_budget);
}

TEST(McapRecords, ASchemaIsThereOnceForAllChannels) {
  std::string file = kMcapBegin + mcap_schema(1, {"a/B", std::string(200'000, '#') + "\n"});
  for (int i = 0; i < 5000; ++i) file += mcap_channel(static_cast<std::uint16_t>(i), 1, "/a");
  const SeenInBag seen = visited(file);
  ASSERT_EQ(seen.connections.size(), 5000u);  // a copy of the schema in each connection would take 1 GB
  EXPECT_EQ(std::string_view(seen.connections[0].definition).data(),
            std::string_view(seen.connections[4999].definition).data());
  EXPECT_LT(seen.connections[0].checksum.size(), 100u);
}

TEST(McapRecords, AreFoundInChunksOfEveryKind) {
  const std::string records = ten_in_mcap();
  for (const std::string& data :
       {records, mcap_chunk(records, "", records), mcap_chunk(records, "lz4", lz4_of(records), crc_of(records)),
        mcap_chunk(records, "zstd", zstd_of(records), crc_of(records)),
        mcap_chunk(records, "zstd", zstd_of(records))}) {
    const SeenInBag seen = visited(kMcapBegin + data + mcap_record(7, "an index") + kTopic + kMcapEnd);
    ASSERT_EQ(seen.messages.size(), 10u);
    EXPECT_EQ(seen.messages[2], "7@2000000 cccc");
    ASSERT_EQ(seen.connections.size(), 2u) << "it is repeated at the end";
    EXPECT_EQ(seen.connections[0].topic, "/a");
    EXPECT_EQ(seen.connections[0].type, "std_msgs/String");
    EXPECT_EQ(seen.connections[0].definition, "string data\n");
    EXPECT_EQ(seen.connections[0].version, RosVersion::two);
    EXPECT_EQ(seen.damage.bytes + seen.damage.chunks, 0u);
  }
}

TEST(McapRecords, ThatWereWholeBeforeACutAreRead) {
  std::vector<std::size_t> ends;
  const std::string records = ten_in_mcap(&ends);
  for (const std::string& begin : {kMcapBegin, kMcapBegin + mcap_chunk(records, "", records)}) {
    const std::string file = begin == kMcapBegin ? begin + records : begin;
    const std::size_t before = file.size() - records.size();
    for (std::size_t size = 0; size <= file.size(); ++size) {
      const auto whole =
          static_cast<std::size_t>(std::ranges::count_if(ends, [&](std::size_t end) { return before + end <= size; }));
      ASSERT_EQ(visited(file.substr(0, size)).messages.size(), whole) << size;
    }
  }
}

TEST(McapRecords, OfAPackThatIsCutAreThoseBeforeTheCut) {
  std::string records = kTopic;
  std::string noise;  // incompressible
  for (unsigned i = 0, x = 1; i < 300'000; ++i) noise += static_cast<char>((x = x * 1664525u + 1013904223u) >> 24U);
  for (std::size_t i = 0; i < 100; ++i) records += mcap_message(7, 1.0, noise.substr(3000 * i, 3000));
  for (const auto& [kind, packed] : {std::pair("lz4", lz4_of(records)), std::pair("zstd", zstd_of(records))}) {
    const std::string file = kMcapBegin + mcap_chunk(records, kind, packed);
    const SeenInBag seen = visited(file.substr(0, file.size() - packed.size() / 4));
    EXPECT_GE(seen.messages.size(), 30u) << kind;
    EXPECT_LT(seen.messages.size(), 100u) << kind;
    EXPECT_EQ(seen.damage.chunks, 1u) << kind;
  }
}

TEST(McapRecords, AfterADamagedPlaceAreFoundAgain) {
  const std::string records = ten_in_mcap();
  const std::string part = mcap_chunk(records, "zstd", zstd_of(records), crc_of(records));
  const std::string file = kMcapBegin + part + part;
  for (std::size_t i = kMcapBegin.size(); i + part.size() < file.size(); ++i) {
    for (const char wrong : {'\xff', '\0', '\x10'}) {
      std::string damaged = file;
      damaged[i] = wrong;
      ASSERT_GE(visited(damaged).messages.size(), 10u) << i;
      ASSERT_LE(visited(damaged).messages.size(), 20u) << i;
    }
  }
}

TEST(McapRecords, OfAChunkWithAWrongChecksumAreNone) {
  const std::string records = ten_in_mcap();
  const SeenInBag seen = visited(kMcapBegin + mcap_chunk(records, "zstd", zstd_of(records), crc_of(records) + 1));
  EXPECT_EQ(seen.messages.size(), 0u);
  EXPECT_EQ(seen.damage.chunks, 1u);
  EXPECT_EQ(visited(kMcapBegin + mcap_chunk(records, "brotli", "whatever")).damage.chunks, 1u);
}

TEST(McapRecords, InOtherEncodingsSaySoInTheirType) {
  const SeenInBag seen = visited(kMcapBegin + mcap_schema(1, {"foxglove.Pose", "{}"}, "jsonschema") +
                                 mcap_channel(1, 1, "/a", "json") + mcap_channel(2, 0, "/b", "json"));
  ASSERT_EQ(seen.connections.size(), 2u);
  EXPECT_EQ(seen.connections[0].type, "foxglove.Pose (json, jsonschema)");
  EXPECT_EQ(seen.connections[0].definition, "");
  EXPECT_EQ(seen.connections[1].type, " (json)");
}

}  // namespace
}  // namespace azimuth::test
