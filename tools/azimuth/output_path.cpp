#include "tools/azimuth/output_path.hpp"

#include <system_error>

#include "tools/azimuth/command.hpp"

namespace azimuth {

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

void write_run(const Run& run, const std::filesystem::path& out) {
  fail_on(is_log_name(out) ? write_run_log(run, out) : write_run_folder(run, out));
}

}  // namespace azimuth
