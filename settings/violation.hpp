#pragma once
// What is wrong with a settings file: all of it at once, each with its place.

#include <string>
#include <vector>

namespace azimuth {

/// One thing wrong with a settings file or with an override of the command line.
struct Violation {
  std::string file;  ///< as given to the reader, or the override itself
  int line = 0;      ///< from 1; 0: the file as a whole
  int column = 0;    ///< from 1; 0: the line as a whole
  std::string message;

  /// `file:line:column: message`, the form editors jump to.
  std::string text() const;
};

using Violations = std::vector<Violation>;

/// One line each.
std::string text(const Violations& violations);

}  // namespace azimuth
