#include "sim/azimuth_sim/run_files.hpp"

#include <cerrno>
#include <cmath>
#include <fmt/ostream.h>
#include <string_view>
#include <utility>

#include "base/file_result.hpp"
#include "sim/world/run_of.hpp"

namespace azimuth::sim {
namespace {

FileResult<void> open_table(std::ofstream& stream, const std::filesystem::path& file, std::string_view header) {
  if (file.empty()) return {};
  errno = 0;
  stream.open(file, std::ios::binary);
  stream << header << std::flush;
  if (!stream) return failure(system_error(file, "cannot be written", errno));
  return {};
}

/// Rounds towards zero, so that an angle just inside [-pi, pi) stays there.
double rounded_angle(double angle_rad) { return std::trunc(angle_rad * 1e6) / 1e6 + 0.0; }

Pose2 rounded(const Pose2& pose) { return {recorded(pose.x_m), recorded(pose.y_m), rounded_angle(pose.heading_rad)}; }

std::string seconds(Stamp stamp) { return fmt::format("{}.{:06}", to_us(stamp) / 1'000'000, to_us(stamp) % 1'000'000); }

}  // namespace

FileResult<RunFiles> RunFiles::create(const RunFileNames& names, const Scenario& scenario, std::string rig_text) {
  RunFiles files(names);
  files.run_ = run_of(scenario);
  if (!rig_text.empty()) files.run_.rig_toml = std::move(rig_text);
  if (auto opened = files.open_tables(); !opened) return failure(opened.error());
  if (!names.run_folder.empty()) {
    if (auto written = write_run_folder(files.run_, names.run_folder); !written) return failure(written.error());
  }
  return files;
}

FileResult<void> RunFiles::open_tables() {
  if (auto opened = open_table(truth_, names_.truth, "t_s,x_m,y_m,heading_rad\n"); !opened) return opened;
  return open_table(sip_log_, names_.sip_log, "t_latch_s,x_raw,y_raw,heading_raw\n");
}

void RunFiles::add(const SimulationOutput& output, const PacedClock& clock) {
  if (truth_.is_open() && !output.truth.empty()) {
    for (const auto& [stamp, pose] : output.truth) {
      const Pose2 row = rounded(pose);
      fmt::print(truth_, "{},{},{},{}\n", seconds(clock.epoch_stamp(stamp)), row.x_m, row.y_m, row.heading_rad);
    }
    truth_.flush();  // A killed process then loses nothing
  }
  if (sip_log_.is_open() && !output.latches.empty()) {
    for (const auto& [stamp, pose] : output.latches) {
      fmt::print(sip_log_, "{},{},{},{}\n", seconds(clock.epoch_stamp(stamp)), pose.x, pose.y, pose.heading);
    }
    sip_log_.flush();
  }
  if (!names_.run_folder.empty()) remember(output, clock);
}

void RunFiles::remember(const SimulationOutput& output, const PacedClock& clock) {
  for (const TruePose& pose : output.truth) {
    run_.truth.push_back({clock.epoch_stamp(pose.stamp), rounded(pose.T_world_body)});
  }
  for (OdometryReading reading : output.odometry) {
    reading.stamp = clock.epoch_stamp(reading.stamp);
    reading.T_odom_body = rounded(reading.T_odom_body);
    run_.odometry.push_back(reading);
  }
  for (const BearingSet& set : output.bearings) {
    BearingSet& kept = run_.bearings.emplace_back(set);
    kept.stamp = clock.epoch_stamp(set.stamp);
    for (Bearing& bearing : kept.bearings) bearing.azimuth_rad = rounded_angle(bearing.azimuth_rad);
  }
}

FileResult<void> RunFiles::finish() {
  for (const auto& [stream, name] : {std::pair(&truth_, &names_.truth), std::pair(&sip_log_, &names_.sip_log)}) {
    if (!stream->is_open()) continue;
    stream->close();
    if (!*stream) return failure(system_error(*name, "not all of it was written", errno));
  }
  if (names_.run_folder.empty()) return {};
  return write_run_folder(run_, names_.run_folder);
}

}  // namespace azimuth::sim
