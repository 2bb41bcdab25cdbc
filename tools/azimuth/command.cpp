#include "tools/azimuth/command.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

namespace azimuth {

void refuse(const std::string& message) { throw CommandError{kBadInput, message}; }
void refuse(const FileErrors& errors) { refuse(text(errors)); }
void refuse(const Violations& violations) { refuse(text(violations)); }
void fail(const std::string& message) { throw CommandError{kFailure, message}; }

void fail_on(const std::optional<FileError>& error) {
  if (error) fail(error->text());
}

Run load_run_or_refuse(const std::filesystem::path& path, const LogOptions& options) {
  FileResult<Run> run = load_run(path, options);
  if (!run) refuse(run.errors());
  return *std::move(run);
}

void write_text(const std::string& text, const std::filesystem::path& file) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) fail(file.string() + ": cannot be written: " + std::strerror(errno));
}

}  // namespace azimuth
