#include "base/file_result.hpp"

namespace azimuth {

std::string FileError::text() const {
  std::string place = file + ':';
  if (line > 0) place += std::to_string(line) + ':';
  if (line > 0 && column > 0) place += std::to_string(column) + ':';
  return place + ' ' + message;
}

std::string text(const FileErrors& errors) {
  std::string lines;
  for (const FileError& error : errors) lines += error.text() + '\n';
  return lines;
}

}  // namespace azimuth
