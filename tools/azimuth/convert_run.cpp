#include "tools/azimuth/convert_run.hpp"

#include <fmt/format.h>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "base/visible.hpp"
#include "drivers/storage/session.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/azimuth/output_path.hpp"
#include "tools/import/raw_images.hpp"

namespace azimuth {
namespace {

constexpr std::string_view kLogMagic = "\xED\xA1\xDA\x01";  // each event of an LCM log begins with it

/// Reads the input run. It needs a rig only if the output is a log, since a run folder can get its rig later.
Run read_input(const Conversion& conversion) {
  LogOptions log = conversion.log;
  log.rig_may_come_later = !is_log_name(conversion.out);
  return load_run_or_refuse(conversion.in, log);
}

void say_what_came(const Conversion& conversion, const Run& run) {
  fmt::print("{}: {} odometry readings, {} bearing sets, {} images\n", shown(conversion.out), run.odometry.size(),
             run.bearings.size(), run.frames.size());
  if (const std::string skipped = run.skipped.text(); !skipped.empty())
    fmt::print("skipped: {}{}\n", skipped, visible(run.perhaps));
  std::error_code ignored;
  const bool has_rig = !run.rig_toml.empty() || std::filesystem::exists(conversion.out / "rig.toml", ignored);
  if (!has_rig) fmt::print("no rig yet; next: {}\n", visible(first_rig(conversion.out, !run.frames.empty())));
}

}  // namespace

bool is_run(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    return std::filesystem::exists(path / "odometry.csv", ignored) || !session_segments(path).empty();
  std::ifstream stream(path, std::ios::binary);
  std::string start(kLogMagic.size(), '\0');
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  return start == kLogMagic;
}

void convert(const Conversion& conversion) {
  std::error_code error;
  if (std::filesystem::equivalent(conversion.in, conversion.out, error))
    refuse(conversion.out.string() + ": is the input itself");
  check_output(conversion.out, conversion.force);
  Run run = read_input(conversion);
  if (!is_log_name(conversion.out))
    if (auto brought = bring_raw_images(run, conversion.out); !brought) refuse(brought.error());
  write_run(run, conversion.out);
  say_what_came(conversion, run);
}

}  // namespace azimuth
