// Encoding and decoding of commands.

#include "drivers/pioneer/protocol.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include "tests/drivers/pioneer/stream.hpp"

namespace azimuth::pioneer {
namespace {

using test::ByteVector;
using test::data_of;
using testing::ElementsAre;

TEST(PioneerProtocol, ArgumentsAreWrittenByTheirType) {
  EXPECT_THAT(data_of(encode_command(Command::pulse)), ElementsAre(0));
  EXPECT_THAT(data_of(encode_command(Command::sonar, 0)), ElementsAre(28, 0x3B, 0, 0));
  EXPECT_THAT(data_of(encode_command(Command::rotation, 300)), ElementsAre(21, 0x3B, 0x2C, 0x01));
  EXPECT_THAT(data_of(encode_command(Command::rotation, -300)), ElementsAre(21, 0x1B, 0x2C, 0x01));
  EXPECT_THAT(data_of(encode_command(Command::say, std::string_view("ab"))), ElementsAre(15, 0x2B, 2, 'a', 'b'));
}

RC_GTEST_PROP(PioneerProtocol, IntegersSurvive, ()) {
  const auto number = *rc::gen::arbitrary<std::uint8_t>();
  const int value = *rc::gen::inRange(-32767, 32768);
  const ByteVector data = data_of(encode_command(number, value));
  const DecodedCommand command = decode_command(data);
  RC_ASSERT(command.number == number);
  RC_ASSERT(command.value == value);
  RC_ASSERT(!command.text);
}

RC_GTEST_PROP(PioneerProtocol, TextsSurvive, ()) {
  auto text = *rc::gen::arbitrary<std::string>();
  text.resize(std::min(text.size(), kMaxArgumentText));
  const ByteVector data = data_of(encode_command(Command::polling, std::string_view(text)));
  const DecodedCommand command = decode_command(data);
  RC_ASSERT(command.is(Command::polling));
  RC_ASSERT(command.text == text);
  RC_ASSERT(!command.value);
}

TEST(PioneerProtocol, ACutOrStrangeArgumentIsOnlyBytes) {
  for (const ByteVector& data :
       {ByteVector{4}, {4, 0x3B}, {4, 0x3B, 1}, {4, 0x2B}, {4, 0x2B, 2, 'a'}, {224, 0, 1, 2}}) {
    const DecodedCommand command = decode_command(data);
    EXPECT_EQ(command.number, data.front());
    EXPECT_FALSE(command.value || command.text);
    EXPECT_EQ(command.argument.size(), data.size() - 1);
  }
}

TEST(PioneerProtocol, BaudCodes) {
  EXPECT_EQ(baud_code(9600), 0);
  EXPECT_EQ(baud_code(38400), 2);
  EXPECT_EQ(baud_code(115200), 4);
  EXPECT_EQ(baud_code(230400), std::nullopt);
  for (int code = 0; code < 5; ++code) EXPECT_EQ(baud_code(*baud_of_code(code)), code);
  EXPECT_EQ(baud_of_code(5), std::nullopt);
  EXPECT_EQ(baud_of_code(-1), std::nullopt);
}

}  // namespace
}  // namespace azimuth::pioneer
