#include "drivers/storage/run.hpp"

#include <algorithm>
#include <string_view>

#include "base/file_result.hpp"
#include "drivers/storage/run_folder.hpp"
#include "drivers/storage/run_log.hpp"
#include "drivers/storage/session.hpp"

namespace azimuth {

namespace fs = std::filesystem;

std::string Skipped::text() const {
  std::string out;
  const auto append = [&out](std::uint64_t count, std::string_view what) {
    if (count == 0) return;
    if (!out.empty()) out += ", ";
    out += std::to_string(count) + ' ' + std::string(what);
  };
  for (const ClockJump& jump : clock_jumps) out += (out.empty() ? "" : ", ") + azimuth::text(jump);
  append(odometry_not_in_order, "odometry readings not in order");
  append(bearings_not_in_order, "bearing sets not in order");
  append(truth_not_in_order, "true poses not in order");
  append(frames_not_in_order, "images not in order");
  append(empty_images, "images without a byte");
  append(unsupported_images, "images in formats that cannot be read");
  append(malformed_messages, "malformed messages");
  append(foreign_events, "events on foreign channels");
  append(damaged_bytes, "damaged bytes");
  append(missing_segments, "segments of the session missing");
  append(unrecorded_events, "events not recorded");
  append(missing_frame_segments, "segments of images missing");
  append(unrecorded_frames, "images not recorded");
  return out;
}

Stamp first_stamp(const Run& run) {
  Stamp first = Stamp::max();
  const auto include = [&first](const auto& records) {
    if (!records.empty()) first = std::min(first, records.front().stamp);
  };
  include(run.odometry);
  include(run.bearings);
  include(run.frames);
  include(run.truth);
  return first == Stamp::max() ? Stamp{} : first;
}

FileResult<Run> load_run(const fs::path& path, const LogOptions& options) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) return failure(FileError{path.string(), 0, "does not exist"});
  if (error) return failure(system_error(path, "cannot be read", error.value()));
  const bool is_session =
      fs::is_directory(status) && !fs::exists(path / kRigFile, error) && !session_segments(path).empty();
  if (fs::is_directory(status) && !is_session && fs::exists(path / "metadata.yaml", error) &&
      !fs::exists(path / kOdometryFile, error))
    return failure(FileError{path.string(), 0, "is a bag of ROS 2: azimuth import makes a run of it"});
  return fs::is_directory(status) && !is_session ? read_run_folder(path, options) : read_run_log(path, options);
}

}  // namespace azimuth
