#include "drivers/storage/map_file.hpp"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <string>
#include <unistd.h>

#include "base/file_result.hpp"
#include "base/files.hpp"
#include "base/unique_fd.hpp"

namespace azimuth {

namespace fs = std::filesystem;

namespace {

constexpr int kMostAside = 9;

fs::path beside(const fs::path& file, const char* ending) { return fs::path(file) += ending; }

bool is_there(const fs::path& file) {
  std::error_code error;
  return fs::exists(fs::symlink_status(file, error));
}

/// True: the file holds a complete, readable map.
bool is_whole(const fs::path& file) {
  const FileResult<MappedFile> mapped = MappedFile::open(file);
  return mapped && !damage_of(mapped->bytes());
}

/// Writes the file and forces it to the disk.
FileResult<void> write_through(Bytes bytes, const fs::path& file) {
  const UniqueFd fd(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
  if (!fd) return failure(system_error(file, "cannot be written", errno));
  if (const int error = write_all(fd.get(), bytes)) return failure(system_error(file, "cannot be written", error));
  if (::fsync(fd.get()) != 0) return failure(system_error(file, "cannot be written", errno));
  return {};
}

FileResult<void> rename_to(const fs::path& from, const fs::path& to) {
  if (std::rename(from.c_str(), to.c_str()) == 0) return {};
  return failure(system_error(to, "cannot be replaced", errno));
}

/// Forces the names of files in the folder to the disk.
FileResult<void> sync_folder(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const UniqueFd fd(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (fd && ::fsync(fd.get()) == 0) return {};
  return failure(system_error(folder, "cannot be written", errno));
}

}  // namespace

fs::path previous_map(const fs::path& file) { return beside(file, ".previous"); }

fs::path located_map(const fs::path& file) { return beside(file, ".located"); }

bool map_exists(const fs::path& file) { return is_there(file) || is_there(previous_map(file)); }

FileResult<LoadedMap> read_map_only(const fs::path& file) {
  const FileResult<MappedFile> mapped = MappedFile::open(file);
  if (!mapped) return failure(mapped.error());
  const Bytes bytes = mapped->bytes();
  if (bytes.size() > kMaxMapBytes) return failure(FileError{file.string(), 0, "is too large for a map"});
  LoadedMap loaded;
  if (const auto problem = decode_map(bytes, loaded.map)) return failure(FileError{file.string(), 0, *problem});
  loaded.bytes.assign(bytes.begin(), bytes.end());
  loaded.file = file;
  return loaded;
}

FileResult<LoadedMap> read_map(const fs::path& file) {
  FileResult<LoadedMap> newest = read_map_only(file);
  if (newest || !is_there(previous_map(file))) return newest;
  FileResult<LoadedMap> previous = read_map_only(previous_map(file));
  FileErrors troubles = newest.error();
  if (previous) {
    previous->troubles = std::move(troubles);
    return previous;
  }
  troubles.insert(troubles.end(), previous.error().begin(), previous.error().end());
  return failure(std::move(troubles));
}

FileResult<void> write_map(Bytes bytes, const fs::path& file) {
  std::error_code error;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), error);
  if (error) return failure(system_error(file.parent_path(), "cannot be made", error.value()));
  const fs::path fresh = beside(file, ".new");
  if (auto written = write_through(bytes, fresh); !written) {
    fs::remove(fresh, error);
    return written;
  }
  if (is_there(file)) {
    const fs::path kept = is_whole(file) ? previous_map(file) : beside(file, ".refused");
    if (auto renamed = rename_to(file, kept); !renamed) return renamed;
  }
  if (auto renamed = rename_to(fresh, file); !renamed) return renamed;
  return sync_folder(file);
}

FileResult<void> set_map_aside(const fs::path& file) {
  if (!is_there(file)) return {};
  int number = 1;
  const auto aside = [&] { return beside(file, (".aside." + std::to_string(number)).c_str()); };
  while (number < kMostAside && is_there(aside())) ++number;
  return rename_to(file, aside());
}

}  // namespace azimuth
