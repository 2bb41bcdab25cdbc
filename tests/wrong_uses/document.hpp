#pragma once
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace azimuth::test {

/// A row of docs/wrong-uses.md.
struct WrongUse {
  std::string number;
  std::string done;     ///< The wrong use in words.
  std::string command;  ///< The shell command.
  int exit_code = -1;   ///< Expected exit code; -1: the cell is not a number.
  std::string answer;   ///< Part of the expected output; … stands for any text within a line.
};

/// Prints the name of the use in the list of tests.
inline void PrintTo(const WrongUse& use, std::ostream* out) { *out << use.done; }

/// All rows of the document's tables, in order.
std::vector<WrongUse> wrong_uses(const std::filesystem::path& document);

/// True if a line of `printed` contains the answer.
bool answers(const std::string& printed, const std::string& answer);

}  // namespace azimuth::test
