#include "settings/command_line/command_line.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace azimuth {
namespace {

/// `azimuth` with a command `map`, which has subcommands, and a command `replay`, which takes an argument.
struct Program {
  CLI::App app{"a program", "azimuth"};
  std::string run;

  Program() {
    app.require_subcommand(1);
    app.add_flag("--quiet");
    CLI::App* const replay = app.add_subcommand("replay");
    replay->add_option("RUN", run)->required();
    replay->add_flag("--verify");
    CLI::App* const map = app.add_subcommand("map");
    map->require_subcommand(1);
    map->add_subcommand("save");
    map->add_subcommand("export");
  }

  /// The error output for the words after the program's name.
  std::string said_of(std::vector<const char*> words) {
    words.insert(words.begin(), "azimuth");
    ::testing::internal::CaptureStderr();
    code = parse_command_line(app, static_cast<int>(words.size()), words.data());
    return ::testing::internal::GetCapturedStderr();
  }
  std::optional<int> code;
};

constexpr const char* kHelp = "Run with --help for more information.\n";

TEST(ParseCommandLine, NamesAnUnknownCommandAndWhatWasMeant) {
  Program program;
  EXPECT_EQ(program.said_of({"reply", "x"}),
            std::string("azimuth: unknown command 'reply'; did you mean 'replay'?\n") + kHelp)
      << "the rest is that one's";
  EXPECT_EQ(program.code, kWrongUsage);
  EXPECT_EQ(Program().said_of({"nonsense"}),
            std::string("azimuth: unknown command 'nonsense'; there are replay, map\n") + kHelp);
  EXPECT_EQ(Program().said_of({"map", "sav"}),
            std::string("azimuth map: unknown command 'sav'; did you mean 'save'?\n") + kHelp);
}

TEST(ParseCommandLine, NamesAnUnknownOptionAndWhatWasMeant) {
  EXPECT_EQ(Program().said_of({"replay", "x", "--verfy"}),
            std::string("azimuth replay: unknown option '--verfy'; did you mean '--verify'?\n") + kHelp);
  EXPECT_EQ(Program().said_of({"replay", "x", "--verif=1"}),
            std::string("azimuth replay: unknown option '--verif'; did you mean '--verify'?\n") + kHelp);
  EXPECT_EQ(Program().said_of({"--colour", "replay", "x"}),
            std::string("azimuth: unknown option '--colour'\n") + kHelp);
}

TEST(ParseCommandLine, TakesAWordBesideAnUnknownOptionForItsValue) {
  EXPECT_EQ(Program().said_of({"replay", "x", "--sped", "2"}),
            std::string("azimuth replay: unknown option '--sped'\n") + kHelp);
}

TEST(ParseCommandLine, NamesWordsTooMany) {
  EXPECT_EQ(Program().said_of({"replay", "x", "y"}), std::string("azimuth replay: 'y' is one word too many\n") + kHelp);
}

TEST(ParseCommandLine, LeavesWhatIsMissingToBeSaid) {
  Program program;
  EXPECT_NE(program.said_of({"replay"}).find("RUN is required"), std::string::npos);
  EXPECT_EQ(program.code, kWrongUsage);
}

TEST(ParseCommandLine, UnderstandsOrIsTold) {
  Program program;
  EXPECT_EQ(program.said_of({"replay", "x"}), "");
  EXPECT_EQ(program.code, std::nullopt);
  EXPECT_EQ(program.run, "x");
  Program refusing;
  const char* const words[] = {"azimuth", "replay", "x"};
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(parse_command_line(refusing.app, 3, words, [] { throw CLI::ValidationError("RUN", "is not for us"); }),
            kWrongUsage);
  EXPECT_NE(::testing::internal::GetCapturedStderr().find("RUN: is not for us"), std::string::npos);
}

}  // namespace
}  // namespace azimuth
