// Runs each command in the tables of docs/wrong-uses.md and compares the answer with the documented one.

#include <chrono>
#include <gtest/gtest.h>
#include <optional>
#include <set>

#include "tests/daemon/child_process.hpp"
#include "tests/support/places.hpp"
#include "tests/support/shipped_run.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/wrong_uses/document.hpp"

namespace azimuth {
namespace {

namespace fs = std::filesystem;
using test::WrongUse;

std::vector<WrongUse> rows() { return test::wrong_uses(test::source_folder() / "docs/wrong-uses.md"); }

struct Ended {
  int exit_code = -1;
  std::string printed;
};

/// Runs the command in a shell in `folder`, whose PATH has the programs.
Ended run(const std::string& command, const fs::path& folder) {
  const std::string script = "PATH=" AZIMUTH_PROGRAMS ":$PATH; cd '" + folder.string() + "'; " + command;
  test::ChildProcess shell({"/bin/sh", "-c", script}, folder);
  const std::optional<int> exit_code = shell.wait(std::chrono::seconds(60));
  return {exit_code.value_or(-1), shell.standard_output() + shell.standard_error()};
}

class WrongUses : public ::testing::TestWithParam<WrongUse> {};

TEST_P(WrongUses, AreAnsweredAsTheDocumentSays) {
  const WrongUse& use = GetParam();
  ASSERT_GE(use.exit_code, 0) << "not a row of five cells: " << use.done;
  test::TemporaryFolder folder;
  test::copy_one_lap(folder / "lab");
  fs::copy(test::source_folder() / "config/rigs", folder.path() / "rigs", fs::copy_options::recursive);
  const Ended ended = run(use.command, folder.path());
  EXPECT_EQ(ended.exit_code, use.exit_code) << use.done << ": " << use.command << '\n' << ended.printed;
  EXPECT_TRUE(test::answers(ended.printed, use.answer)) << use.done << ": " << use.command << "\nis not answered by\n"
                                                        << use.answer << "\nbut by\n"
                                                        << ended.printed;
}

INSTANTIATE_TEST_SUITE_P(Document, WrongUses, ::testing::ValuesIn(rows()),
                         [](const auto& use) { return "Row" + use.param.number; });

TEST(WrongUsesDocument, HasFortyRowsAndMoreEachWithItsNumber) {
  std::set<std::string> numbers;
  for (const WrongUse& use : rows()) EXPECT_TRUE(numbers.insert(use.number).second) << use.number;
  EXPECT_GE(numbers.size(), 40U);
}

TEST(WrongUsesDocument, AnswersAreComparedLineByLine) {
  EXPECT_TRUE(test::answers("one\ntwo: 3 of 4\n", "two: \xE2\x80\xA6 of 4"));
  EXPECT_FALSE(test::answers("one\ntwo\n", "one\xE2\x80\xA6two"));
  EXPECT_FALSE(test::answers("", "x"));
}

}  // namespace
}  // namespace azimuth
