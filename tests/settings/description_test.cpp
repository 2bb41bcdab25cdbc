#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <vector>

#include "settings/command_line/command_line.hpp"

namespace azimuth {
namespace {

using Json = nlohmann::json;

/// `azimuth` with a command that takes options of all types.
struct Described {
  CLI::App app{"a program", "azimuth"};
  std::filesystem::path report;
  std::vector<std::string> runs;
  std::string front_end, world = "lab";
  int every = 10;
  bool quiet = false;

  Described() {
    app.require_subcommand(1);
    CLI::App* const replay = app.add_subcommand("replay", "Run it");
    replay->footer("Exit codes: 0.");
    replay->add_option("RUN", runs, "Run folder")->required();
    replay->add_option("-o,--report", report, "Write the report");
    replay->add_option("--front-end", front_end)->check(CLI::IsMember({"sift", "lamps"}));
    replay->add_option("--world", world)->type_name(choices_text({"lab", "hall"}))->capture_default_str();
    replay->add_option("--every", every)->check(CLI::Range(1, 100))->capture_default_str();
    replay->add_flag("--quiet", quiet);
    replay->add_option("--secret", front_end)->group("");
  }

  /// The description that a caller of `azimuth` receives.
  Json told() {
    const char* const words[] = {"azimuth", kDescribe};
    ::testing::internal::CaptureStdout();
    code = parse_command_line(app, 2, words);
    return Json::parse(::testing::internal::GetCapturedStdout());
  }
  std::optional<int> code;
};

Json option_of(const Json& command, const std::string& name) {
  for (const Json& option : command["options"])
    if (option["positional"] == name || (!option["names"].empty() && option["names"].back() == name)) return option;
  return nullptr;
}

TEST(Description, IsPrintedThoughACommandIsMissing) {
  Described program;
  const Json told = program.told();
  EXPECT_EQ(program.code, 0);
  EXPECT_EQ(told["name"], "azimuth");
  EXPECT_EQ(told["about"], "a program");
  ASSERT_EQ(told["commands"].size(), 1U);
  EXPECT_EQ(told["commands"][0]["footer"], "Exit codes: 0.");
}

TEST(Description, TellsWhatOptionsTake) {
  const Json replay = Described().told()["commands"][0];
  EXPECT_EQ(option_of(replay, "--report")["names"], Json({"-o", "--report"}));
  EXPECT_EQ(option_of(replay, "--report")["value"], "PATH");
  EXPECT_EQ(option_of(replay, "--front-end")["choices"], Json({"sift", "lamps"}));
  EXPECT_EQ(option_of(replay, "--world")["choices"], Json({"lab", "hall"}));
  EXPECT_EQ(option_of(replay, "--world")["default"], "lab");
  EXPECT_EQ(option_of(replay, "--every")["value"], "INT");
  EXPECT_NE(option_of(replay, "--every")["limits"].get<std::string>().find("1 - 100"), std::string::npos);
  EXPECT_EQ(option_of(replay, "--quiet")["value"], "") << "a flag";
}

TEST(Description, TellsWordsThatAreNoOptions) {
  const Json run = option_of(Described().told()["commands"][0], "RUN");
  EXPECT_TRUE(run["names"].empty());
  EXPECT_TRUE(run["required"].get<bool>());
  EXPECT_TRUE(run["repeats"].get<bool>());
}

TEST(Description, LeavesOutWhatIsHidden) {
  const Json told = Described().told();
  EXPECT_TRUE(option_of(told["commands"][0], "--secret").is_null());
  EXPECT_TRUE(option_of(told, kDescribe).is_null());
}

TEST(Description, IsNotSuggested) {
  Described program;
  const char* const words[] = {"azimuth", "--describe-command-lin"};
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(parse_command_line(program.app, 2, words), kWrongUsage);
  EXPECT_EQ(::testing::internal::GetCapturedStderr().find("did you mean"), std::string::npos);
}

}  // namespace
}  // namespace azimuth
