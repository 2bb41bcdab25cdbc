// Effects and answers of the run-time commands, on lines and on a socket.

#include "sim/azimuth_sim/console.hpp"

#include <array>
#include <cstring>
#include <filesystem>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "sim/azimuth_sim/line_input.hpp"

namespace azimuth::sim {
namespace {

namespace fs = std::filesystem;

class ConsoleTest : public testing::Test {
 public:
  Simulation simulation{{lab(1), PioneerModel{}, {}, std::nullopt}};
  Console console{simulation};
};

TEST_F(ConsoleTest, AppliesFaults) {
  EXPECT_EQ(console.obey("  lose_sips=0.5 ", Stamp{}), "lose_sips=0.5\n");
  EXPECT_EQ(console.obey("unplug=3", Stamp{}), "unplug=3\n");
  EXPECT_FALSE(simulation.pioneer().plugged_in());
}

TEST_F(ConsoleTest, SaysWhatItDoesNotUnderstand) {
  EXPECT_NE(console.obey("explode", Stamp{}).find("\"explode\" is not known"), std::string::npos);
  EXPECT_NE(console.obey("noise=loud", Stamp{}).find("0..1"), std::string::npos);
  EXPECT_EQ(console.obey("", Stamp{}), "");
}

TEST_F(ConsoleTest, HelpsAndQuits) {
  EXPECT_NE(console.obey("help", Stamp{}).find("bad_config_checksum"), std::string::npos);
  EXPECT_NE(console.obey("status", Stamp{}).find("no session"), std::string::npos);
  EXPECT_FALSE(console.wants_to_quit());
  console.obey("quit", Stamp{});
  EXPECT_TRUE(console.wants_to_quit());
}

class LineInputTest : public testing::Test {
 public:
  void TearDown() override { fs::remove(path); }

  UniqueFd connect() const {
    sockaddr_un where{};
    where.sun_family = AF_UNIX;
    std::strncpy(where.sun_path, path.c_str(), sizeof where.sun_path - 1);
    UniqueFd fd(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    EXPECT_EQ(::connect(fd.get(), reinterpret_cast<sockaddr*>(&where), sizeof where), 0);
    return fd;
  }
  void turn(LineInput& input) {
    for (int i = 0; i < 5; ++i) {
      std::vector<pollfd> watched;
      input.watch(watched);
      ::poll(watched.data(), watched.size(), 10);
      input.turn(watched);
    }
  }

  fs::path path = fs::path(testing::TempDir()) / ("line_input_" + std::to_string(::getpid()));
  std::vector<std::string> lines;
  LineInput::Handler echo = [this](const std::string& line) {
    lines.push_back(line);
    return "<" + line + ">\n";
  };
};

TEST_F(LineInputTest, AnswersEachLineOfEachClient) {
  LineInput input(echo);
  ASSERT_TRUE(input.open_socket(path));
  const UniqueFd first = connect(), second = connect();
  ASSERT_EQ(::write(first.get(), "a\r\nb\nha", 7), 7);
  ASSERT_EQ(::write(second.get(), "c\n", 2), 2);
  turn(input);
  ASSERT_EQ(::write(first.get(), "lf\n", 3), 3);
  turn(input);
  EXPECT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines.back(), "half");
  std::array<char, 64> answer{};
  ASSERT_GT(::read(first.get(), answer.data(), answer.size()), 0);
  EXPECT_STREQ(answer.data(), "<a>\n<b>\n<half>\n");
}

TEST_F(LineInputTest, OutlivesItsClients) {
  LineInput input(echo);
  ASSERT_TRUE(input.open_socket(path));
  for (int i = 0; i < 20; ++i) {
    const UniqueFd client = connect();
    ASSERT_EQ(::write(client.get(), "x\ny\nz\n", 6), 6);
    ::shutdown(client.get(), SHUT_RDWR);
    turn(input);
  }
  const UniqueFd endless = connect();
  const std::string flood(10'000, 'q');
  ASSERT_GT(::write(endless.get(), flood.data(), flood.size()), 0);
  for (int i = 0; i < 10; ++i) turn(input);
  EXPECT_LE(lines.size(), 60U);
  const UniqueFd client = connect();
  ASSERT_EQ(::write(client.get(), "still here\n", 11), 11);
  turn(input);
  EXPECT_EQ(lines.back(), "still here");
}

TEST_F(LineInputTest, ReplacesAStaleSocketAndRemovesItsOwn) {
  {
    LineInput input(echo);
    ASSERT_TRUE(input.open_socket(path));
    LineInput successor(echo);
    ASSERT_TRUE(successor.open_socket(path));
  }
  EXPECT_FALSE(fs::exists(path));
  LineInput nowhere(echo);
  EXPECT_FALSE(nowhere.open_socket(path / "below"));
}

}  // namespace
}  // namespace azimuth::sim
