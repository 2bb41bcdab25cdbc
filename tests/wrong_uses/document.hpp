#pragma once
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace azimuth::test {

/// A row of docs/wrong-uses.md.
struct WrongUse {
  std::string number;
  std::string done;     ///< in words
  std::string command;  ///< for a shell
  int exit_code = -1;   ///< -1: not a number
  std::string answer;   ///< part of what is printed; the sign … stands for anything within a line
};

/// Its name among the tests.
inline void PrintTo(const WrongUse& use, std::ostream* out) { *out << use.done; }

/// Every row of the document's table, in order.
std::vector<WrongUse> wrong_uses(const std::filesystem::path& document);

/// Whether a line of `printed` has the answer in it.
bool answers(const std::string& printed, const std::string& answer);

}  // namespace azimuth::test
