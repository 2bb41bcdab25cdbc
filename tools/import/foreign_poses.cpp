#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "drivers/wire/bot_odometry.hpp"
#include "drivers/wire/plausible.hpp"
#include "tools/import/foreign_rows.hpp"
#include "tools/import/foreign_samples.hpp"
#include "tools/import/wheel_odometry.hpp"

namespace azimuth {
namespace {

// Columns of poses.
constexpr std::array<WantedColumn, 14> kPose{{{"t_s"},
                                              {"x_m", false},
                                              {"y_m", false},
                                              {"heading_rad", false},
                                              {"qx", false},
                                              {"qy", false},
                                              {"qz", false},
                                              {"qw", false},
                                              {"left_m", false},
                                              {"right_m", false},
                                              {"left_rad", false},
                                              {"right_rad", false},
                                              {"speed_m_s", false},
                                              {"turn_rad_s", false}}};
constexpr std::size_t kT = 0, kX = 1, kY = 2, kHeading = 3, kQx = 4, kQy = 5, kQz = 6, kQw = 7, kLeft = 8, kRight = 9,
                      kLeftAngle = 10, kRightAngle = 11, kSpeed = 12, kTurn = 13, kTruthColumns = 8;

bool is_plausible_component(double q) { return std::abs(q) <= 1.01; }
bool is_plausible_wheel_angle(double angle_rad) { return std::abs(angle_rad) <= kMaxCoordinate_m; }

/// The heading from either kind of column. Nothing, with an error, if it is invalid.
std::optional<double> read_heading(ForeignTable& reader) {
  if (reader.has(kHeading)) return reader.number(kHeading, is_plausible_heading);
  const auto component = [&reader](std::size_t column) {
    return reader.has(column) ? reader.number(column, is_plausible_component) : std::optional(0.0);
  };
  const auto qx = component(kQx), qy = component(kQy), qz = component(kQz), qw = component(kQw);
  if (!qx || !qy || !qz || !qw) return std::nullopt;
  const std::optional<double> heading_rad = heading_of(*qx, *qy, *qz, *qw);
  if (!heading_rad) reader.fail("qx, qy, qz, qw are no rotation: their squares must add up to 1");
  return heading_rad;
}

/// A pose without a known heading.
std::optional<Pose2> read_position(ForeignTable& reader) {
  const auto x_m = reader.number(kX, is_plausible_coordinate);
  const auto y_m = reader.number(kY, is_plausible_coordinate);
  if (!x_m || !y_m) return std::nullopt;
  return Pose2{*x_m, *y_m, std::numeric_limits<double>::quiet_NaN()};
}

std::optional<Pose2> read_pose(ForeignTable& reader) {
  const auto x_m = reader.number(kX, is_plausible_coordinate);
  const auto y_m = reader.number(kY, is_plausible_coordinate);
  const auto heading_rad = read_heading(reader);
  if (!x_m || !y_m || !heading_rad) return std::nullopt;
  return Pose2{*x_m, *y_m, wrap(*heading_rad)};
}

bool has_heading(const ForeignTable& reader) { return reader.has(kHeading) || (reader.has(kQz) && reader.has(kQw)); }
bool has_pose(const ForeignTable& reader) { return reader.has(kX) && reader.has(kY) && has_heading(reader); }
bool has_distances(const ForeignTable& reader) { return reader.has(kLeft) && reader.has(kRight); }
bool has_angles(const ForeignTable& reader) { return reader.has(kLeftAngle) && reader.has(kRightAngle); }
bool has_speeds(const ForeignTable& reader) { return reader.has(kSpeed) && reader.has(kTurn); }

/// The columns that a table lacks for poses, as text; empty if it is complete.
std::string lacks_pose(const ForeignText& table, const ForeignTable& reader, bool with_heading) {
  std::string lacks;
  if (!reader.has(kX)) lacks += "x_m, ";
  if (!reader.has(kY)) lacks += "y_m, ";
  if (with_heading && !has_heading(reader)) lacks += "heading_rad (or qz and qw), ";
  if (lacks.empty()) return {};
  lacks.resize(lacks.size() - 2);
  return "nothing says which column is " + lacks + ": " + table.option + " t_s=COLUMN,x_m=COLUMN,...";
}

std::string lacks_odometry(const ForeignText& table, const ForeignTable& reader, const Wheels& wheels) {
  if (has_pose(reader)) return {};
  const bool distances = has_distances(reader);
  if (!distances && !has_angles(reader)) return has_speeds(reader) ? std::string() : lacks_pose(table, reader, true);
  if (!(wheels.track_m > 0.0)) return "wheels need the distance between them: --track METRES";
  if (!distances && !(wheels.radius_m > 0.0)) return "angles of wheels need their radius: --wheel-radius METRES";
  return {};
}

/// Computes poses from speeds, for tables without poses.
class SpeedReader {
 public:
  explicit SpeedReader(Stamp first) : stamp_(first) {}

  /// The pose at `stamp`, with speeds interpolated linearly between rows. If rows are far apart, the reading contains
  /// the standard deviation of the interpolation error.
  OdometryReading read(Stamp stamp, double speed_m_s, double turn_rad_s) {
    constexpr double kShort_s = 0.5;
    OdometryReading reading{.stamp = stamp, .T_odom_body = {}};
    const double elapsed_s = to_seconds(stamp - stamp_);
    reading.T_odom_body =
        path_.drive(0.5 * (speed_m_s_ + speed_m_s) * elapsed_s, 0.5 * (turn_rad_s_ + turn_rad_s) * elapsed_s);
    if (elapsed_s > kShort_s) {
      reading.sigma_gap_m = 0.5 * elapsed_s * std::max(std::abs(speed_m_s_), std::abs(speed_m_s));
      reading.sigma_gap_rad = 0.5 * elapsed_s * std::max(std::abs(turn_rad_s_), std::abs(turn_rad_s));
    }
    stamp_ = stamp;
    speed_m_s_ = speed_m_s;
    turn_rad_s_ = turn_rad_s;
    return reading;
  }

 private:
  WheelPath path_{1.0};
  Stamp stamp_;  // stamp of the last reading
  double speed_m_s_ = 0.0, turn_rad_s_ = 0.0;
};

bool is_plausible_speed(double speed) { return std::abs(speed) <= 1000.0; }

/// A row of odometry as three numbers: a pose, the distances rolled by two wheels, or two speeds.
std::optional<std::array<double, 3>> read_motion(ForeignTable& reader) {
  if (has_pose(reader)) {
    const std::optional<Pose2> pose = read_pose(reader);
    if (!pose) return std::nullopt;
    return std::array{pose->x_m, pose->y_m, pose->heading_rad};
  }
  const bool distances = has_distances(reader), angles = !distances && has_angles(reader);
  const std::size_t first = distances ? kLeft : angles ? kLeftAngle : kSpeed;
  const auto fits = distances ? is_plausible_coordinate : angles ? is_plausible_wheel_angle : is_plausible_speed;
  const auto one = reader.number(first, fits), other = reader.number(first + 1, fits);
  if (!one || !other) return std::nullopt;
  return std::array{*one, *other, 0.0};
}

struct Motion3 {
  Stamp stamp{};
  std::array<double, 3> values{};
};

/// Odometry from the rows, according to the columns that the table has.
FileResult<std::vector<OdometryReading>> odometry_of(const std::vector<Motion3>& rows, const ForeignTable& reader,
                                                     const Wheels& wheels, const std::string& file, TableNotes& notes) {
  std::vector<OdometryReading> readings;
  if (has_pose(reader)) {
    for (const auto& [stamp, pose] : rows)
      readings.push_back({.stamp = stamp, .T_odom_body = {pose[0], pose[1], pose[2]}});
  } else if (has_distances(reader) || has_angles(reader)) {
    const bool distances = has_distances(reader);
    const double metres = distances ? 1.0 : wheels.radius_m;
    std::vector<WheelReading> rolled;
    for (const auto& [stamp, wheel] : rows) rolled.push_back({stamp, metres * wheel[0], metres * wheel[1]});
    const WheelCounts counts{metres * reader.factor(distances ? kLeft : kLeftAngle),
                             metres * reader.factor(distances ? kRight : kRightAngle)};
    return wheel_odometry(std::move(rolled), counts, wheels.track_m, file, notes.sentences);
  } else if (!rows.empty()) {
    SpeedReader by_speeds(rows.front().stamp);
    for (const auto& [stamp, speed] : rows) readings.push_back(by_speeds.read(stamp, speed[0], speed[1]));
  }
  number_odometry(readings);
  return readings;
}

}  // namespace

FileResult<std::vector<OdometryReading>> foreign_odometry(const ForeignText& table, const Wheels& wheels,
                                                          TableNotes& notes) {
  using Rows = std::vector<Motion3>;
  RepeatedStamps stamps;
  std::optional<FileResult<std::vector<OdometryReading>>> odometry;
  const auto check = [&](const ForeignTable& reader) { return lacks_odometry(table, reader, wheels); };
  const auto use = [&](ForeignTable& reader, Rows& rows) {
    const std::optional<Stamp> stamp = reader.stamp(kT);
    const std::optional<std::array<double, 3>> motion = read_motion(reader);
    if (stamps.keeps(reader, stamp, motion.value_or(std::array<double, 3>{})) && motion)
      rows.push_back({*stamp, *motion});
  };
  const auto judge = [&](const ForeignTable& reader, const Rows& rows) {
    std::string problem = stamps.problem();
    if (problem.empty() && !rows.empty()) odometry = odometry_of(rows, reader, wheels, table.file, notes);
    return problem;
  };
  const FileResult<Rows> rows = read_rows<Rows>(table, kPose, check, use, judge);
  if (!rows) return failure(rows.error());
  notes.repeated += stamps.count();
  return *std::move(odometry);
}

FileResult<std::vector<TruthPose>> foreign_truth(const ForeignText& table, TableNotes& notes) {
  using Rows = std::vector<TruthPose>;
  RepeatedStamps stamps;
  const auto check = [&](const ForeignTable& reader) { return lacks_pose(table, reader, false); };
  const auto use = [&](ForeignTable& reader, Rows& rows) {
    const std::optional<Stamp> stamp = reader.stamp(kT);
    const std::optional<Pose2> pose = has_heading(reader) ? read_pose(reader) : read_position(reader);
    const std::array<double, 3> values{pose ? pose->x_m : 0.0, pose ? pose->y_m : 0.0, 0.0};
    if (stamps.keeps(reader, stamp, values) && pose) rows.push_back({.stamp = *stamp, .T_world_body = *pose});
  };
  const auto rows = read_rows<Rows>(table, std::span(kPose).first(kTruthColumns), check, use,
                                    [&](const ForeignTable&, const Rows&) { return stamps.problem(); });
  notes.repeated += stamps.count();
  return rows;
}

}  // namespace azimuth
