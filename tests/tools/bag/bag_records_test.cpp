#include "tools/bag/bag_records.hpp"

#include <algorithm>
#include <bzlib.h>
#include <gtest/gtest.h>
#include <lz4frame.h>
#include <span>
#include <string>
#include <vector>

#include "tests/tools/bag/seen_in_bag.hpp"
#include "tests/tools/import/ros_messages.hpp"

namespace azimuth::test {
namespace {

std::string u32(std::size_t value) { return RosBytes().u32(static_cast<std::uint32_t>(value)).bytes(); }
std::string field(const std::string& name, const std::string& value) {
  return u32(name.size() + 1 + value.size()) + name + '=' + value;
}
std::string record(char op, const std::string& fields, const std::string& data) {
  const std::string header = field("op", std::string(1, op)) + fields;
  return u32(header.size()) + header + u32(data.size()) + data;
}

std::string connection(std::size_t id, const std::string& topic) {
  return record(7, field("conn", u32(id)) + field("topic", topic),
                field("topic", topic) + field("type", "std_msgs/String") + field("md5sum", "123") +
                    field("message_definition", "string data\n"));
}
std::string message(std::size_t connection, std::size_t second, const std::string& data) {
  return record(2, field("conn", u32(connection)) + field("time", u32(second) + u32(500)), data);
}
std::string chunk(const std::string& compression, const std::string& data, std::size_t unpacked) {
  return record(5, field("compression", compression) + field("size", u32(unpacked)), data);
}
std::string bag_begin() { return std::string(kBagMagic) + record(3, field("index_pos", std::string(8, '\0')), "    "); }

using Seen = SeenInBag;

Seen visit(const std::string& bag) { return seen_in(bag, visit_bag); }

/// Ten messages of different lengths; `ends` receives the offset at which each one ends.
std::string ten_messages(std::vector<std::size_t>* ends = nullptr) {
  std::string records = connection(3, "/a");
  for (std::size_t i = 0; i < 10; ++i) {
    records += message(3, i, std::string(i * i, static_cast<char>('a' + i)));
    if (ends != nullptr) ends->push_back(records.size());
  }
  return records;
}

std::string bz2(const std::string& text) {
  std::string packed(2 * text.size() + 1000, '\0');
  auto size = static_cast<unsigned>(packed.size());
  EXPECT_EQ(BZ2_bzBuffToBuffCompress(packed.data(), &size, const_cast<char*>(text.data()),
                                     static_cast<unsigned>(text.size()), 1, 0, 0),
            BZ_OK);
  packed.resize(size);
  return packed;
}

std::string lz4(const std::string& text) {
  std::string packed(LZ4F_compressFrameBound(text.size(), nullptr), '\0');
  packed.resize(LZ4F_compressFrame(packed.data(), packed.size(), text.data(), text.size(), nullptr));
  return packed;
}

/// A chunk of zeros, which unpacks to far more bytes than it takes.
std::string bomb(std::size_t unpacked) {
  const std::string zeros(unpacked, '\0');
  return chunk("bz2", bz2(zeros), unpacked);
}

TEST(BagRecords, ABombIsLeftAloneAndSaidToBeOne) {
  const Seen seen = visit(bag_begin() + bomb(40'000'000) + ten_messages());
  EXPECT_TRUE(seen.damage.beyond_budget);
  EXPECT_TRUE(seen.messages.empty()) << "it is not read on";
}

TEST(BagRecords, ManySmallBombsAreOne) {
  const std::string small = bomb(1'000'000);
  std::string bag = bag_begin() + ten_messages();
  for (int i = 0; i < 40; ++i) bag += small;
  const Seen seen = visit(bag);
  EXPECT_TRUE(seen.damage.beyond_budget);
  EXPECT_EQ(seen.messages.size(), 10u);
}

TEST(BagRecords, StillImagesThatPackWellAreNoBomb) {
  const std::string image = connection(3, "/image") + message(3, 1, std::string(9'000'000, 'x'));
  const Seen seen = visit(bag_begin() + chunk("bz2", bz2(image), image.size()) +
                          chunk("bz2", bz2(image), image.size()) + chunk("lz4", lz4(image), image.size()));
  EXPECT_FALSE(seen.damage.beyond_budget);
  EXPECT_EQ(seen.messages.size(), 3u);
}

/// Each chunk begins within the one before it, so a naive reader would read the rest of the file once per chunk.
TEST(BagRecords, ChunksWithinChunksCostNoMoreThanOneBudget) {
  std::string begins;
  const std::string begin = record(5, field("compression", "bz2") + field("size", u32(1)), "");
  for (int i = 0; i < 20'000; ++i) begins += begin;
  std::string noise(900'000, '\0');
  std::uint32_t random = 1;
  for (char& c : noise) c = static_cast<char>((random = random * 1664525u + 1013904223u) >> 24U);
  const Seen seen = visit(bag_begin() + begins + bz2(noise));
  EXPECT_TRUE(seen.damage.beyond_budget);
}

TEST(BagRecords, TellHowFarTheyAre) {
  std::string bag = bag_begin() + connection(3, "/a");
  for (std::size_t i = 0; i < 10; ++i) bag += message(3, i, std::string(100'000, 'x'));
  std::vector<std::size_t> told;
  BagVisitor visitor;
  visitor.connection = [](const BagConnection&) {};
  visitor.message = [](std::uint32_t, Stamp, Bytes) {};
  visitor.progress = [&](std::size_t done_B, std::size_t all_B) {
    EXPECT_EQ(all_B, bag.size());
    told.push_back(done_B);
    if (told.size() == 5) throw 5;
  };
  EXPECT_THROW(visit_bag(std::as_bytes(std::span(bag)), visitor), int);
  EXPECT_EQ(told.size(), 5u);
  EXPECT_TRUE(std::ranges::is_sorted(told));
}

TEST(BagRecords, AreFoundInChunksOfEveryKind) {
  const std::string records = ten_messages();
  for (const std::string& data : {chunk("none", records, records.size()), chunk("bz2", bz2(records), records.size()),
                                  chunk("lz4", lz4(records), records.size()), records}) {
    const Seen seen = visit(bag_begin() + data + record(4, field("conn", u32(3)), "index") + connection(3, "/a"));
    ASSERT_EQ(seen.messages.size(), 10u);
    EXPECT_EQ(seen.messages[2], "3@2000001 cccc");
    ASSERT_EQ(seen.connections.size(), 2u) << "it is repeated at the end";
    EXPECT_EQ(seen.connections[0].topic, "/a");
    EXPECT_EQ(seen.connections[0].type, "std_msgs/String");
    EXPECT_EQ(seen.connections[0].definition, "string data\n");
    EXPECT_EQ(seen.connections[0].checksum, "123");
    EXPECT_EQ(seen.damage.bytes + seen.damage.chunks, 0u);
  }
}

TEST(BagRecords, ThatWereWholeBeforeACutAreRead) {
  std::vector<std::size_t> ends;
  const std::string records = ten_messages(&ends);
  const std::string bag = bag_begin() + chunk("none", records, records.size());
  const std::size_t before = bag.size() - records.size();
  for (std::size_t size = 0; size <= bag.size(); ++size) {
    const auto whole =
        static_cast<std::size_t>(std::ranges::count_if(ends, [&](std::size_t end) { return before + end <= size; }));
    ASSERT_EQ(visit(bag.substr(0, size)).messages.size(), whole) << size;
  }
}

TEST(BagRecords, OfACutBagAreNoPiecesOfWhatIsPacked) {
  const std::string records = ten_messages();
  for (const std::string& packed : {bz2(records), lz4(records)}) {
    const std::string part = chunk(packed.starts_with("BZ") ? "bz2" : "lz4", packed, records.size());
    const std::string bag = bag_begin() + part + part;
    const std::vector<std::string> all = visit(bag).messages;
    ASSERT_EQ(all.size(), 20u);
    for (std::size_t size = 0; size < bag.size(); ++size) {
      const std::vector<std::string> some = visit(bag.substr(0, size)).messages;
      ASSERT_TRUE(some.size() <= all.size() && std::equal(some.begin(), some.end(), all.begin())) << size;
    }
    for (std::size_t i = bag.size() - part.size(); i < bag.size(); ++i) {
      std::string damaged = bag;
      damaged[i] = 'x';
      ASSERT_LE(visit(damaged).messages.size(), 20u) << i;
    }
  }
}

TEST(BagRecords, ThatLieInsideOfACutPackAreNone) {
  for (const char* kind : {"lz4", "bz2"}) {
    const std::string bag = bag_begin() + chunk(kind, connection(3, "/a") + message(3, 1, "abc") + "....", 8);
    const Seen seen = visit(bag.substr(0, bag.size() - 2));
    EXPECT_EQ(seen.messages.size(), 0u) << kind;
    EXPECT_EQ(seen.connections.size(), 0u) << kind;
  }
}

TEST(BagRecords, OfAChunkThatWasNeverClosedAreRead) {
  const std::string records = ten_messages();
  EXPECT_EQ(visit(bag_begin() + chunk("none", "", 0) + records).messages.size(), 10u);
  const std::string packed = bz2(records);
  const Seen seen = visit(bag_begin() + chunk("bz2", "", 0) + packed.substr(0, packed.size() - 4));
  EXPECT_EQ(seen.messages.size(), 10u) << "all but the checksum is there";
  EXPECT_EQ(seen.damage.chunks, 1u);
}

TEST(BagRecords, AfterADamagedPlaceAreFoundAgain) {
  const std::string records = ten_messages();
  const std::string bag = bag_begin() + chunk("none", records, records.size()) + chunk("none", records, records.size());
  for (std::size_t i = kBagMagic.size(); i + records.size() < bag.size(); ++i) {
    for (const char wrong : {'\xff', '\0', '\x10'}) {
      std::string damaged = bag;
      damaged[i] = wrong;
      ASSERT_GE(visit(damaged).messages.size(), 10u) << i;
    }
  }
}

TEST(BagRecords, OfADamagedChunkAloneAreLost) {
  const std::string records = ten_messages();
  for (std::string packed : {bz2(records), lz4(records)}) {
    const std::string kind = packed.starts_with("BZ") ? "bz2" : "lz4";
    const std::string good = chunk(kind, packed, records.size());
    for (std::size_t i = 4; i < 20; ++i) packed[i] = 'x';
    const Seen seen = visit(bag_begin() + good + chunk(kind, packed, records.size()) + good);
    EXPECT_EQ(seen.messages.size(), 20u) << kind;
    EXPECT_EQ(seen.damage.chunks, 1u) << kind;
    EXPECT_EQ(seen.damage.bytes, 0u) << kind;
  }
}

TEST(BagRecords, OfAnUnknownCompressionAreADamagedChunk) {
  EXPECT_EQ(visit(bag_begin() + chunk("zip", "whatever", 8)).damage.chunks, 1u);
}

TEST(BagRecords, OfAnEncryptedBagSaySo) {
  const std::string bag = std::string(kBagMagic) + record(3, field("encryptor", "rosbag/AesCbcEncryptor"), "    ");
  EXPECT_TRUE(visit(bag).damage.encrypted);
  EXPECT_FALSE(visit(bag_begin()).damage.encrypted);
}

TEST(RosStamp, IsToTheNearestMicrosecond) {
  EXPECT_EQ(ros_stamp(1, 499), stamp_from_us(1'000'000));
  EXPECT_EQ(ros_stamp(1, 500), stamp_from_us(1'000'001));
  EXPECT_EQ(ros_stamp(0xffffffff, 999'999'999), stamp_from_us(4'294'967'296'000'000));
}

TEST(BagRecords, ConnectionsNameTheirSenders) {
  const std::string named = record(7, field("conn", u32(4)) + field("topic", "/a"),
                                   field("topic", "/a") + field("type", "std_msgs/String") + field("md5sum", "123") +
                                       field("message_definition", "string data\n") + field("callerid", "/base"));
  const Seen seen = visit(bag_begin() + named + connection(5, "/a"));
  ASSERT_EQ(seen.connections.size(), 2u);
  EXPECT_EQ(seen.connections[0].sender, "/base");
  EXPECT_EQ(seen.connections[1].sender, "");
}

}  // namespace
}  // namespace azimuth::test
