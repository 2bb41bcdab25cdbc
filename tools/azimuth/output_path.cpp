#include "tools/azimuth/output_path.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "tools/azimuth/command.hpp"
#include "tools/plot/plot_format.hpp"

namespace azimuth {
namespace {

/// Whether a rename may replace the file: it is neither a link nor a pipe, which must be written through.
bool may_be_replaced(const std::filesystem::path& file) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::symlink_status(file, ignored);
  return !std::filesystem::exists(status) || std::filesystem::is_regular_file(status);
}

/// The temporary file beside a log, which holds the log until it is complete.
class PartOfLog {
 public:
  explicit PartOfLog(const std::filesystem::path& log) : file_(log.string() + ".part") {}
  PartOfLog(const PartOfLog&) = delete;
  PartOfLog& operator=(const PartOfLog&) = delete;
  ~PartOfLog() {
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
  }
  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
};

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

bool is_log_name(const std::filesystem::path& out) {
  const std::filesystem::path extension = out.extension();
  return extension == ".lcmlog" || extension == ".lcm" || extension == ".log";
}

void check_output(const std::filesystem::path& out, bool force) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(out, error);
  if (!std::filesystem::exists(status)) return;
  const bool is_folder = std::filesystem::is_directory(status);
  if (is_folder && is_log_name(out)) refuse(out.string() + ": is a folder, but its name asks for an LCM log");
  if (!is_folder && !is_log_name(out)) refuse(out.string() + ": is a file, but its name asks for a run folder");
  if (is_folder && std::filesystem::is_empty(out, error)) return;
  if (!force) refuse(out.string() + ": exists already; --force replaces it");
}

void check_picture_name(const std::filesystem::path& file) {
  if (file.empty() || plot_format(file)) return;
  refuse(file.string() + ": the name of a picture must end in .png, .svg or .pdf");
}

void check_writable(const std::filesystem::path& file) {
  if (file.empty()) return;
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (std::filesystem::is_directory(status)) fail(file.string() + ": cannot be written: is a folder");
  const bool is_new = !std::filesystem::exists(status);
  if (!is_new && !std::filesystem::is_regular_file(status)) return;
  const int opened = ::open(file.c_str(), O_WRONLY | O_CLOEXEC | (is_new ? O_CREAT | O_EXCL : 0), 0666);
  if (opened < 0) fail(file.string() + ": cannot be written: " + std::strerror(errno));
  ::close(opened);
  if (is_new) std::filesystem::remove(file, error);
}

void write_run(const Run& run, const std::filesystem::path& out, const WriteProgress& progress) {
  if (!is_log_name(out)) return fail_on(write_run_folder(run, out));
  if (!may_be_replaced(out)) return fail_on(write_run_log(run, out, {}, progress));
  const PartOfLog part(out);
  if (FileResult<void> written = write_run_log(run, part.file(), {}, progress); !written) {
    for (FileError& error : written.error())
      if (error.file == part.file()) error.file = out.string();
    fail(written.error());
  }
  std::error_code error;
  std::filesystem::rename(part.file(), out, error);
  if (error) fail(FileErrors{system_error(out.string(), "cannot be written", error.value())});
}

namespace fs = std::filesystem;

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
