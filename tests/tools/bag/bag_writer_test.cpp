#include "tools/bag/bag_writer.hpp"

#include <gtest/gtest.h>
#include <span>
#include <string>
#include <vector>

#include "tools/bag/bag_records.hpp"

namespace azimuth::test {
namespace {

const BagConnection kFirst{0, "/first", "std_msgs/String", "string data\n", std::string(32, 'a')};
const BagConnection kSecond{0, "/second", "std_msgs/Empty", "", std::string(32, 'b')};

struct Read {
  std::vector<BagConnection> connections;
  std::vector<std::string> messages;
  BagDamage damage;
};

Read read(const std::string& bag) {
  Read seen;
  BagVisitor visitor;
  visitor.connection = [&](const BagConnection& each) { seen.connections.push_back(each); };
  visitor.message = [&](std::uint32_t id, Stamp recorded, Bytes bytes) {
    seen.messages.push_back(std::to_string(id) + '@' + std::to_string(to_us(recorded)) + ' ' +
                            std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  };
  seen.damage = visit_bag(std::as_bytes(std::span(bag.data(), bag.size())), visitor);
  return seen;
}

std::string small_bag() {
  BagWriter writer;
  const std::uint32_t first = writer.connect(kFirst), second = writer.connect(kSecond);
  writer.message(first, {1, 500'000'000}, "one");
  writer.message(second, {2, 0}, "");
  writer.message(first, {3, 999'999'000}, std::string("t\0o", 3));
  return writer.finish();
}

TEST(BagWriter, IsReadByOurReader) {
  const Read seen = read(small_bag());
  EXPECT_EQ(seen.damage.bytes + seen.damage.chunks, 0u);
  EXPECT_EQ(seen.messages,
            (std::vector<std::string>{"0@1500000 one", "1@2000000 ", std::string("0@3999999 t\0o", 13)}));
  ASSERT_EQ(seen.connections.size(), 4u) << "each in its chunk, and at the end";
  EXPECT_EQ(seen.connections[0].topic, kFirst.topic);
  EXPECT_EQ(seen.connections[0].type, kFirst.type);
  EXPECT_EQ(seen.connections[0].definition, kFirst.definition);
  EXPECT_EQ(seen.connections[0].checksum, kFirst.checksum);
  EXPECT_EQ(seen.connections[1].topic, kSecond.topic);
}

TEST(BagWriter, GivesTheSameBytesEachTime) { EXPECT_EQ(small_bag(), small_bag()); }

TEST(BagWriter, MakesChunksOfALimitedSize) {
  BagWriter writer;
  const std::uint32_t id = writer.connect(kFirst);
  const std::string large(BagWriter::kChunkBytes / 3, 'x');
  for (std::uint32_t i = 0; i < 20; ++i) writer.message(id, {i, 1}, large);
  const std::string bag = writer.finish();
  std::size_t chunks = 0;
  for (std::size_t at = 0; (at = bag.find("compression=none", at)) != std::string::npos; ++at) ++chunks;
  EXPECT_EQ(chunks, 7u);
  EXPECT_EQ(read(bag).messages.size(), 20u);
}

TEST(BagWriter, WithoutAMessageHasConnectionsAlone) {
  BagWriter writer;
  writer.connect(kFirst);
  const Read seen = read(writer.finish());
  EXPECT_EQ(seen.connections.size(), 1u);
  EXPECT_EQ(seen.messages.size(), 0u);
  EXPECT_EQ(seen.damage.bytes, 0u);
}

TEST(BagWriter, CutAnywhereLosesNoMessageBeforeTheCut) {
  const std::string bag = small_bag();
  std::size_t before = 0;
  for (std::size_t size = 0; size <= bag.size(); ++size) {
    const std::size_t now = read(bag.substr(0, size)).messages.size();
    EXPECT_GE(now, before) << size;
    before = now;
  }
  EXPECT_EQ(before, 3u);
}

}  // namespace
}  // namespace azimuth::test
