#include "drivers/io/text_file.hpp"

#include <cerrno>
#include <fcntl.h>

#include "drivers/io/mapped_file.hpp"
#include "drivers/io/system_error.hpp"
#include "drivers/io/unique_fd.hpp"
#include "drivers/io/write_all.hpp"

namespace azimuth {

FileResult<std::string> read_text_file(const std::filesystem::path& file) {
  const FileResult<MappedFile> mapped = MappedFile::open(file);
  if (!mapped) return failure(mapped.error());
  const Bytes bytes = mapped->bytes();
  if (bytes.empty()) return std::string{};
  return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

FileResult<void> write_text_file(const std::filesystem::path& file, std::string_view text) {
  const UniqueFd fd(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
  if (!fd) return failure(system_error(file, "cannot be written", errno));
  if (const int error = write_all(fd.get(), std::as_bytes(std::span(text)))) {
    return failure(system_error(file, "cannot be written", error));
  }
  return {};
}

}  // namespace azimuth
