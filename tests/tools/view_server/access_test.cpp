#include "tools/view_server/access.hpp"

#include <gmock/gmock.h>

#include "tools/view_server/listening_socket.hpp"

namespace azimuth::test {
namespace {

using testing::HasSubstr;

TEST(Access, SecretsAreComparedWhole) {
  EXPECT_TRUE(same_secret("abc", "abc"));
  EXPECT_FALSE(same_secret("abc", "abd"));
  EXPECT_FALSE(same_secret("abc", "ab"));
  EXPECT_FALSE(same_secret("", "a"));
}

TEST(Access, TokensAreRandom) {
  EXPECT_NE(random_token(), random_token());
  EXPECT_FALSE(why_no_token(random_token()));
}

TEST(Access, TokensThatAreNone) {
  EXPECT_THAT(*why_no_token("short"), HasSubstr("5 characters"));
  EXPECT_THAT(*why_no_token("a token with spaces in it"), HasSubstr("letters"));
  EXPECT_THAT(*why_no_token("0123456789abcdef\r\nSet-Cookie: x"), HasSubstr("letters"));
}

TEST(Access, OwnNamesOfThisMachine) {
  for (const char* const host : {"localhost", "localhost:8017", "127.0.0.1", "127.0.0.1:80", "[::1]:8017", "[::1]"})
    EXPECT_TRUE(is_own_name(host)) << host;
  for (const char* const host : {"", "evil.example", "localhost.evil.example", "127.0.0.1.evil.example", "[::1",
                                 "192.168.1.7", "[2001:db8::1]:80"})
    EXPECT_FALSE(is_own_name(host)) << host;
}

TEST(Access, SocketsThatCannotBe) {
  const auto first = listening_socket("127.0.0.1", 0);
  ASSERT_TRUE(first);
  EXPECT_THAT(listening_socket("127.0.0.1", port_of(*first)).error(), HasSubstr("somebody else listens"));
  EXPECT_THAT(listening_socket("203.0.113.7", 0).error(), HasSubstr("no such address"));
  EXPECT_THAT(listening_socket("robot.local", 0).error(), HasSubstr("in numbers"));
}

}  // namespace
}  // namespace azimuth::test
