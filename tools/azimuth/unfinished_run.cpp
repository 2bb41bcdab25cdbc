#include "tools/azimuth/unfinished_run.hpp"

#include <system_error>
#include <utility>

#include "tools/azimuth/command.hpp"
#include "tools/azimuth/output_path.hpp"

namespace azimuth {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFiles = ".unfinished";

void fail_with(const fs::path& file, const std::error_code& error) {
  if (error) fail(FileErrors{system_error(file.string(), "cannot be written", error.value())});
}

/// Moves each file below `from` to the same place below `into`.
void move_files(const fs::path& from, const fs::path& into) {
  std::error_code error;
  for (fs::recursive_directory_iterator entry(from, error), end; !error && entry != end; entry.increment(error)) {
    const fs::path place = into / entry->path().lexically_relative(from);
    std::error_code moved;
    if (entry->is_directory(moved))
      fs::create_directories(place, moved);
    else
      fs::rename(entry->path(), place, moved);
    fail_with(place, moved);
  }
  fail_with(from, error);
}

}  // namespace

UnfinishedRun::UnfinishedRun(fs::path out) : out_(std::move(out)), files_(out_ / kFiles) {
  std::error_code ignored;
  was_there_ = fs::exists(out_, ignored);
  if (!is_log_name(out_)) fs::remove_all(files_, ignored);  // left by a killed program
}

UnfinishedRun::~UnfinishedRun() {
  if (is_log_name(out_)) return;  // write_run() removes an unfinished log
  std::error_code ignored;
  fs::remove_all(finished_ || was_there_ ? files_ : out_, ignored);
}

void UnfinishedRun::finish(const Run& run, const WriteProgress& progress) {
  std::error_code ignored;
  if (!is_log_name(out_) && fs::exists(files_, ignored)) move_files(files_, out_);
  write_run(run, out_, progress);
  finished_ = true;
}

}  // namespace azimuth
