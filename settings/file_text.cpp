#include "settings/file_text.hpp"

#include <cerrno>
#include <fstream>
#include <system_error>

namespace azimuth {
namespace {

/// Reads the stream to its end, but stops a little beyond kLargestText, since a device file has no end.
std::string text_in(std::istream& stream) {
  constexpr std::size_t kPiece = std::size_t{1} << 16U;
  std::string text;
  while (stream && text.size() <= kLargestText) {
    const std::size_t before = text.size();
    text.resize(before + kPiece);
    stream.read(text.data() + before, kPiece);
    text.resize(before + static_cast<std::size_t>(stream.gcount()));
  }
  return text;
}

}  // namespace

FileResult<std::string> file_text(const std::filesystem::path& file) {
  const auto refuse = [&](const std::string& why) {
    return failure(FileError{file.string(), 0, "cannot be read: " + why});
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) return refuse("is a directory");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return refuse(std::generic_category().message(errno));
  std::string text = text_in(stream);
  if (stream.bad()) return refuse(std::generic_category().message(errno));
  if (text.size() > kLargestText) return refuse("is larger than " + std::to_string(kLargestText >> 20U) + " MB");
  return text;
}

}  // namespace azimuth
