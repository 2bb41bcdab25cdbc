// A serial bridge in telnet mode, which modifies the robot's bytes.

#include "drivers/pioneer/telnet.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <vector>

namespace azimuth::pioneer {
namespace {

using testing::ElementsAre;
using Bytes = std::vector<std::uint8_t>;

/// Undoes telnet in pieces of `piece` bytes.
Bytes undone(Telnet& telnet, const Bytes& bytes, std::size_t piece) {
  Bytes robots;
  for (std::size_t begin = 0; begin < bytes.size(); begin += piece) {
    const auto end = std::min(begin + piece, bytes.size());
    Bytes part(bytes.begin() + static_cast<std::ptrdiff_t>(begin), bytes.begin() + static_cast<std::ptrdiff_t>(end));
    part.resize(telnet.undo(part));
    robots.insert(robots.end(), part.begin(), part.end());
  }
  return robots;
}

class TelnetTest : public testing::TestWithParam<std::size_t> {};

TEST_P(TelnetTest, IsUndone) {
  Telnet telnet;
  const Bytes said{0xFF, 0xFB, 3,    0xFF, 0xFD, 0,    0xFA, 0xFB, 0xFF, 0xFF,
                   7,    0xFF, 0xFA, 44,   1,    0xFF, 0xF0, 0xFF, 0xF1, 9};
  EXPECT_THAT(undone(telnet, said, GetParam()), ElementsAre(0xFA, 0xFB, 0xFF, 7, 9));
  EXPECT_TRUE(telnet.is_spoken());
}

TEST_P(TelnetTest, IsNotSeenInWhatARawBridgeSends) {
  Telnet telnet;
  const Bytes said{0xFA, 0xFB, 0xFF, 0xFB, 3, 0xFF, 0xFF, 7};
  EXPECT_EQ(undone(telnet, said, GetParam()), said);
  EXPECT_FALSE(telnet.is_spoken());
}

TEST_P(TelnetTest, IsNotSeenInTheMiddleOfAPacketEither) {
  Telnet telnet;
  EXPECT_THAT(undone(telnet, {0xFF, 0x00, 0xFF, 0xFB, 5}, GetParam()), ElementsAre(0x00, 0xFF, 0xFB, 5));
  EXPECT_FALSE(telnet.is_spoken());
}

INSTANTIATE_TEST_SUITE_P(InPieces, TelnetTest, testing::Values(1, 2, 3, 64));

TEST(Telnet, AgreesToBinaryTransmissionOnceEachWay) {
  Telnet telnet;
  Bytes offers{0xFF, 0xFB, 0, 0xFF, 0xFD, 0, 0xFF, 0xFD, 1};
  EXPECT_EQ(telnet.undo(offers), 0U);
  std::vector<int> answers;
  while (const auto answer = telnet.take_answer()) answers.push_back(answer->command * 256 + answer->option);
  EXPECT_THAT(answers, ElementsAre(0xFD00, 0xFB00));
  Bytes again{0xFF, 0xFB, 0, 0xFF, 0xFD, 0};
  telnet.undo(again);
  EXPECT_FALSE(telnet.take_answer()) << "or the two would never end";
}

}  // namespace
}  // namespace azimuth::pioneer
