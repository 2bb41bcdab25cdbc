#include "drivers/wire/pieces.hpp"

#include <gtest/gtest.h>

namespace azimuth {
namespace {

path_t piece(std::int64_t seq, std::int32_t chunk, std::int32_t chunks) {
  path_t message{};
  message.seq = seq;
  message.chunk = chunk;
  message.chunks = chunks;
  message.n = 1;
  message.poses.resize(1);
  message.poses[0].utime = 10 * seq + chunk;
  message.utime = 100 * seq;
  return message;
}

TEST(Pieces, MakeAWholeInAnyOrder) {
  PathPieces path;
  EXPECT_FALSE(path.take(piece(1, 2, 3)));
  EXPECT_FALSE(path.take(piece(1, 0, 3)));
  EXPECT_FALSE(path.take(piece(1, 0, 3))) << "the same once more";
  EXPECT_TRUE(path.take(piece(1, 1, 3)));
  ASSERT_EQ(path.whole().size(), 3u);
  EXPECT_EQ(path.whole()[2].utime, 12);
  EXPECT_EQ(path.utime(), 100);
  EXPECT_EQ(path.incomplete(), 0u);
}

TEST(Pieces, KeepTheLastWholeUntilTheNext) {
  PathPieces path;
  EXPECT_TRUE(path.take(piece(1, 0, 1)));
  EXPECT_FALSE(path.take(piece(2, 0, 2)));
  EXPECT_EQ(path.whole()[0].utime, 10);
  EXPECT_TRUE(path.take(piece(3, 0, 1)));
  EXPECT_EQ(path.whole()[0].utime, 30);
  EXPECT_EQ(path.incomplete(), 1u);
}

TEST(Pieces, OfTheSameNumberComeAgainAfterARestart) {
  PathPieces path;
  EXPECT_TRUE(path.take(piece(1, 0, 1)));
  EXPECT_TRUE(path.take(piece(1, 0, 1)));
}

}  // namespace
}  // namespace azimuth
