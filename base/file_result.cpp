#include "base/file_result.hpp"

#include <system_error>

#include "base/visible.hpp"

namespace azimuth {

std::string FileError::text() const {
  std::string place = visible(file) + ':';
  if (line > 0) place += std::to_string(line) + ':';
  if (line > 0 && column > 0) place += std::to_string(column) + ':';
  return place + ' ' + visible(message);
}

FileError system_error(std::string file, std::string_view what, int error_number) {
  return {std::move(file), 0, std::string(what) + ": " + std::generic_category().message(error_number)};
}

std::string text(const FileErrors& errors) {
  std::string lines;
  for (const FileError& error : errors) lines += error.text() + '\n';
  return lines;
}

void FileErrorList::add(int line, std::string message) {
  if (count_++ < kMost) errors_.push_back({file_, line, std::move(message)});
}

void FileErrorList::move_to(FileErrors& all) && {
  if (count_ > kMost) errors_.push_back({file_, 0, "and " + std::to_string(count_ - kMost) + " more errors"});
  for (FileError& error : errors_) all.push_back(std::move(error));
}

}  // namespace azimuth
