#include "settings/file_text.hpp"

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

namespace azimuth {

FileResult<std::string> file_text(const std::filesystem::path& file) {
  const auto refuse = [&](const std::string& why) {
    return failure(FileError{file.string(), 0, "cannot be read: " + why});
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) return refuse("is a directory");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return refuse(std::generic_category().message(errno));
  std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (stream.bad()) return refuse(std::generic_category().message(errno));
  return text;
}

}  // namespace azimuth
