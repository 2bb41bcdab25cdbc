#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/tools/azimuth/command_line.hpp"

namespace azimuth::test {
namespace {

using testing::HasSubstr;

TEST(DoctorCommand, AnErrorIsTheExitCode) {
  const Outcome outcome = azimuth({"doctor", "--device", "/dev/no-such-device"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("error    serial      /dev/no-such-device is not there"));
  EXPECT_EQ(outcome.err, "");
}

TEST(DoctorCommand, PrintsJson) {
  const Outcome outcome = azimuth({"doctor", "--json", "--device", "/dev/no-such-device"});
  EXPECT_EQ(outcome.code, 1);
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["verdict"], "error");
  EXPECT_GT(json["findings"].size(), 10U);
}

TEST(DoctorCommand, RefusesAnUnknownUser) {
  const Outcome outcome = azimuth({"doctor", "--user", "no such user"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("no such user"));
}

}  // namespace
}  // namespace azimuth::test
