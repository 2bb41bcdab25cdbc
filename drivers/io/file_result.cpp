#include "drivers/io/file_result.hpp"

namespace azimuth {

std::string FileError::text() const { return file + ':' + (line > 0 ? std::to_string(line) + ": " : " ") + message; }

std::string text(const FileErrors& errors) {
  std::string lines;
  for (const FileError& error : errors) lines += error.text() + '\n';
  return lines;
}

}  // namespace azimuth
