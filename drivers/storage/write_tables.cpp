#include <algorithm>
#include <cmath>

#include "drivers/storage/tables.hpp"
#include "drivers/wire/number_text.hpp"
#include "slam/sample/odometry_steps.hpp"

namespace azimuth {

namespace {

void append_position(std::string& out, Stamp stamp, const Pose2& pose) {
  append_seconds(out, stamp);
  append_double(out += ',', pose.x_m);
  append_double(out += ',', pose.y_m);
}

void append_pose(std::string& out, Stamp stamp, const Pose2& pose) {
  append_position(out, stamp, pose);
  append_double(out += ',', pose.heading_rad);
}

struct OdometryColumns {
  bool origin = false;
  bool gaps = false;
};

/// Decides which columns are needed. A reader of a table without origins detects restarts of the odometer by itself.
OdometryColumns columns_needed(std::span<const OdometryReading> readings) {
  OdometryColumns columns;
  OdometrySteps steps;
  for (const OdometryReading& reading : readings) {
    columns.gaps = columns.gaps || reading.sigma_gap_m != 0.0 || reading.sigma_gap_rad != 0.0;
    columns.origin = columns.origin || reading.origin != readings.front().origin || steps.next(reading);
  }
  columns.origin = columns.origin || columns.gaps;
  return columns;
}

/// Appends a value; NaN (unknown) becomes an empty field.
void append_optional(std::string& out, double value) {
  out += ',';
  if (!std::isnan(value)) append_double(out, value);
}

struct BearingColumns {
  bool elevation = false;
  bool landmark = false;
  bool kind = false;
  bool sigma = false;
  bool radius = false;
  bool sigma_elevation = false;
};

BearingColumns columns_needed(std::span<const BearingSet> sets) {
  BearingColumns columns;
  for (const BearingSet& set : sets) {
    for (const Bearing& bearing : set.bearings) {
      columns.elevation = columns.elevation || !std::isnan(bearing.elevation_rad);
      columns.landmark = columns.landmark || bearing.identity != kUnknownIdentity;
      columns.kind = columns.kind || bearing.kind != kAnyKind;
      columns.sigma = columns.sigma || !std::isnan(bearing.sigma_rad);
      columns.radius = columns.radius || !std::isnan(bearing.radius_px);
      columns.sigma_elevation = columns.sigma_elevation || !std::isnan(bearing.sigma_elevation_rad);
    }
  }
  return columns;
}

void append_bearing_row(std::string& out, Stamp stamp, const Bearing& bearing, const BearingColumns& columns) {
  append_seconds(out, stamp);
  out += ',';
  append_double(out, bearing.azimuth_rad);
  if (columns.elevation) append_optional(out, bearing.elevation_rad);
  if (columns.landmark) {
    out += ',';
    append_integer(out, bearing.identity);
  }
  if (columns.kind) {
    out += ',';
    append_integer(out, bearing.kind);
  }
  if (columns.sigma) append_optional(out, bearing.sigma_rad);
  if (columns.radius) append_optional(out, bearing.radius_px);
  if (columns.sigma_elevation) append_optional(out, bearing.sigma_elevation_rad);
  out += '\n';
}

void append_empty_set(std::string& out, const BearingSet& set, const BearingColumns& columns) {
  append_seconds(out, set.stamp);
  out += ',';
  out += kEmptySetWords.at(static_cast<std::size_t>(set.trouble));
  for (const bool column :
       {columns.elevation, columns.landmark, columns.kind, columns.sigma, columns.radius, columns.sigma_elevation})
    if (column) out += ',';
  out += '\n';
}

constexpr std::string_view kPoseHeader = "t_s,x_m,y_m,heading_rad";

}  // namespace

std::string odometry_table(std::span<const OdometryReading> readings) {
  const OdometryColumns columns = columns_needed(readings);
  std::string out(kPoseHeader);
  if (columns.origin) out += ",origin";
  if (columns.gaps) out += ",sigma_gap_m,sigma_gap_rad";
  out += '\n';
  for (const OdometryReading& reading : readings) {
    append_pose(out, reading.stamp, reading.T_odom_body);
    if (columns.origin) append_integer(out += ',', reading.origin);
    if (columns.gaps) {
      append_double(out += ',', reading.sigma_gap_m);
      append_double(out += ',', reading.sigma_gap_rad);
    }
    out += '\n';
  }
  return out;
}

std::string truth_table(std::span<const TruthPose> poses) {
  const bool has_heading =
      std::ranges::none_of(poses, [](const auto& pose) { return std::isnan(pose.T_world_body.heading_rad); });
  std::string out(has_heading ? kPoseHeader : "t_s,x_m,y_m");
  out += '\n';
  for (const TruthPose& pose : poses) {
    (has_heading ? append_pose : append_position)(out, pose.stamp, pose.T_world_body);
    out += '\n';
  }
  return out;
}

bool fits_table(const BearingSet& set) {
  const bool has_looks = !set.descriptors.empty() || !set.neighbours.empty();
  return !has_looks && (set.trouble == ImageTrouble::none || set.bearings.empty());
}

std::string bearings_table(std::span<const BearingSet> sets) {
  const BearingColumns columns = columns_needed(sets);
  std::string out = "t_s,azimuth_rad";
  if (columns.elevation) out += ",elevation_rad";
  if (columns.landmark) out += ",landmark_id";
  if (columns.kind) out += ",kind";
  if (columns.sigma) out += ",sigma_rad";
  if (columns.radius) out += ",radius_px";
  if (columns.sigma_elevation) out += ",sigma_elevation_rad";
  out += '\n';
  for (const BearingSet& set : sets) {
    if (set.bearings.empty()) append_empty_set(out, set, columns);
    for (const Bearing& bearing : set.bearings) append_bearing_row(out, set.stamp, bearing, columns);
  }
  return out;
}

std::string frames_table(std::span<const FrameFile> frames) {
  std::string out = "t_s,file\n";
  for (const FrameFile& frame : frames) {
    append_seconds(out, frame.stamp);
    out += ',' + frame.file + '\n';
  }
  return out;
}

std::string landmarks_table(std::span<const TrueLandmark> landmarks) {
  const bool heights = std::ranges::any_of(landmarks, [](const auto& landmark) { return !std::isnan(landmark.z_m); });
  const bool kinds = std::ranges::any_of(landmarks, [](const auto& landmark) { return !landmark.kind.empty(); });
  std::string out = "landmark_id,x_m,y_m";
  if (heights) out += ",z_m";
  if (kinds) out += ",kind";
  out += '\n';
  for (const TrueLandmark& landmark : landmarks) {
    append_integer(out, landmark.identity);
    append_optional(out, landmark.x_m);
    append_optional(out, landmark.y_m);
    if (heights) append_optional(out, landmark.z_m);
    if (kinds) out += ',' + landmark.kind;
    out += '\n';
  }
  return out;
}

}  // namespace azimuth
