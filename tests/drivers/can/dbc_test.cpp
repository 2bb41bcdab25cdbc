#include "drivers/can/dbc.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace azimuth {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Optional;

constexpr const char* kGood = R"(VERSION "1.0"

NS_ :
	CM_
	BA_

BS_:
BU_: ECU Host
VAL_TABLE_ Gears 1 "SG_ is no signal here" 0 "off" ;

BO_ 256 Wheels: 8 ECU
 SG_ Left : 7|16@0- (0.001,0) [-32|32] "m/s" Host
 SG_ Right:23|16@0- (1E-3,0) [-32|32] "m/s" Host,Other
 SG_ Beyond : 60|8@1+ (1,0) [0|0] "" Host

BO_ 2566844926 Extended : 64 ECU
 SG_ Late : 504|8@1+ (+2,-1.5) [0|0] "" Vector__XXX

BO_ 300 Muxed: 8 ECU
 SG_ Page M : 0|4@1+ (1,0) [0|0] "" Host
 SG_ First m0 : 8|16@1+ (1,0) [0|0] "" Host
 SG_ Third m3 : 8|32@1- (1,0) [0|0] "" Host

BO_ 301 Deep: 8 ECU
 SG_ A M : 0|4@1+ (1,0) [0|0] "" Host
 SG_ B m0M : 4|4@1+ (1,0) [0|0] "" Host
 SG_ C m1 : 8|4@1+ (1,0) [0|0] "" Host

BO_ 302 Lost: 8 ECU
 SG_ D m1 : 8|4@1+ (1,0) [0|0] "" Host

BO_ 3221225472 VECTOR__INDEPENDENT_SIG_MSG: 0 Vector__XXX
 SG_ Orphan : 0|8@1+ (1,0) [0|0] "" Vector__XXX

EV_ Unknown: 0 [0|0] "" 0 1 DUMMY_NODE_VECTOR0 Vector__XXX;
CM_ SG_ 256 Left "A comment of two lines,
BO_ 1 NoFrame: broken, for it is \"text\"
 SG_ none at all";
SIG_VALTYPE_ 300 Third : 1;
SIG_VALTYPE_ 256 Left : 2;
SIG_VALTYPE_ 999 Nobody : 1;
)";

Dbc good() {
  FileResult<Dbc> read = read_dbc(kGood, "base.dbc");
  EXPECT_TRUE(read) << text(read.error());
  return read ? *read : Dbc{};
}

std::vector<std::string> errors_of(const std::string& text) {
  const FileResult<Dbc> read = read_dbc(text, "bad.dbc");
  std::vector<std::string> lines;
  if (!read)
    for (const FileError& error : read.error()) lines.push_back(error.text());
  return lines;
}

TEST(Dbc, ReadsFramesAndSignals) {
  const Dbc dbc = good();
  ASSERT_EQ(dbc.messages.size(), 5U);
  EXPECT_EQ(dbc.messages[0].name, "Wheels");
  EXPECT_EQ(dbc.messages[0].id, (CanId{256, false}));
  EXPECT_EQ(dbc.messages[0].size, 8);
  const DbcSignal* const right = dbc.find("Wheels.Right");
  ASSERT_NE(right, nullptr);
  EXPECT_EQ(right->problem, std::nullopt);
  EXPECT_EQ(right->line, 13);
  EXPECT_EQ(right->signal.bits, (CanBits{23, 16, CanByteOrder::motorola}));
  EXPECT_EQ(right->signal.number, CanNumber::signed_integer);
  EXPECT_EQ(right->signal.scale, 0.001);
  EXPECT_EQ(right->signal.frame, (CanId{256, false}));
}

TEST(Dbc, ReadsExtendedIdsAndFramesOfCanFd) {
  const Dbc dbc = good();
  const DbcSignal* const late = dbc.find("Extended.Late");
  ASSERT_NE(late, nullptr);
  EXPECT_EQ(late->signal.frame, (CanId{0x18FEF1FE, true}));
  EXPECT_EQ(late->signal.bits, (CanBits{504, 8, CanByteOrder::intel}));
  EXPECT_EQ(late->signal.number, CanNumber::unsigned_integer);
  EXPECT_EQ(late->signal.scale, 2.0);
  EXPECT_EQ(late->signal.offset, -1.5);
  EXPECT_EQ(late->problem, std::nullopt);
}

TEST(Dbc, ReadsSimpleMultiplexing) {
  const Dbc dbc = good();
  EXPECT_FALSE(dbc.find("Muxed.Page")->signal.multiplexer);
  const CanSignal::Multiplexer third{{0, 4, CanByteOrder::intel}, 3};
  EXPECT_EQ(dbc.find("Muxed.Third")->signal.multiplexer, third);
  EXPECT_EQ(dbc.find("Muxed.Third")->signal.number, CanNumber::ieee_float);
  EXPECT_EQ(dbc.find("Muxed.First")->signal.multiplexer->value, 0U);
}

TEST(Dbc, SignalsThatCannotBeUsedSaySo) {
  const Dbc dbc = good();
  EXPECT_EQ(dbc.find("Wheels.Beyond")->problem, "reaches beyond the 8 bytes of its frame");
  EXPECT_THAT(dbc.find("Wheels.Left")->problem, Optional(HasSubstr("float of 64 bits in 16")));
  EXPECT_THAT(dbc.find("Deep.C")->problem, Optional(HasSubstr("extended multiplexing")));
  EXPECT_THAT(dbc.find("Deep.B")->problem, Optional(HasSubstr("extended multiplexing")));
  EXPECT_EQ(dbc.find("Deep.A")->problem, std::nullopt);
  EXPECT_THAT(dbc.find("Lost.D")->problem, Optional(HasSubstr("no multiplexer")));
}

TEST(Dbc, FindsNothingElse) {
  const Dbc dbc = good();
  for (const char* const name :
       {"", ".", "Wheels", "Wheels.", "Wheels.left", ".Left", "NoFrame.x", "VECTOR__INDEPENDENT_SIG_MSG.Orphan"})
    EXPECT_EQ(dbc.find(name), nullptr) << name;
}

TEST(Dbc, ErrorsHaveTheirLine) {
  EXPECT_THAT(errors_of("\n SG_ Left : 0|8@1+ (1,0) [0|0] \"\" X\n"),
              ElementsAre("bad.dbc:2: SG_ stands outside a frame"));
  EXPECT_THAT(
      errors_of("BO_ 1 A: 8 X\r\n SG_ Left : 0|8@2+ (1,0) [0|0] \"\" X\r\nBO_ x\nBO_ 2048 B: 8 X\nBO_ 1 C: 65 X\n"),
      ElementsAre(HasSubstr("bad.dbc:2: is no signal"), HasSubstr("bad.dbc:3: is no frame"),
                  HasSubstr("bad.dbc:4: id 2048 is too large"), HasSubstr("bad.dbc:5: is no frame")));
  EXPECT_THAT(errors_of("BO_ 1 A: 8 X\n SG_ Left : 0|8@1+\n (1,0) [0|0] \"\" X\n"),
              ElementsAre(HasSubstr("bad.dbc:2:")))
      << "a statement does not go on in the next line";
  EXPECT_THAT(errors_of("SIG_VALTYPE_ 1 A : 4;\n"), ElementsAre(HasSubstr("bad.dbc:1: is no value type")));
  EXPECT_THAT(errors_of("\nCM_ \"for ever\nBO_ 1 A: 8 X\n"), ElementsAre("bad.dbc:2: begins a string that has no end"));
}

TEST(Dbc, EverySignalThatIsWrittenWronglyIsRefused) {
  for (const char* const wrong : {"SG_ : 0|8@1+ (1,0)",
                                  "SG_ A 0|8@1+ (1,0)",
                                  "SG_ A : |8@1+ (1,0)",
                                  "SG_ A : 0 8@1+ (1,0)",
                                  "SG_ A : 0|@1+ (1,0)",
                                  "SG_ A : 0|8 1+ (1,0)",
                                  "SG_ A : 0|8@+ (1,0)",
                                  "SG_ A : 0|8@1 (1,0)",
                                  "SG_ A : 0|8@1+ 1,0)",
                                  "SG_ A : 0|8@1+ (,0)",
                                  "SG_ A : 0|8@1+ (1 0)",
                                  "SG_ A : 0|8@1+ (1,)",
                                  "SG_ A : 0|8@1+ (1,0",
                                  "SG_ A : -1|8@1+ (1,0)",
                                  "SG_ A : 0|99999999999999999999@1+ (1,0)",
                                  "SG_ A : 0|9999999999@1+ (1,0)",
                                  "SG_ A : 0|8@1+ (nan,0)",
                                  "SG_ A : 0|8@1+ (1,inf)",
                                  "SG_ A x1 : 0|8@1+ (1,0)",
                                  "SG_ A m : 0|8@1+ (1,0)",
                                  "SG_ A m1x : 0|8@1+ (1,0)"})
    EXPECT_EQ(errors_of(std::string("BO_ 1 A: 8 X\n ") + wrong + "\n").size(), 1U) << wrong;
}

TEST(Dbc, AnEmptyFileHasNothing) { EXPECT_TRUE(read_dbc("", "empty.dbc")->messages.empty()); }

}  // namespace
}  // namespace azimuth
