#include "tools/import/foreign_samples.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "drivers/wire/plausible.hpp"
#include "tools/import/foreign_table.hpp"

namespace azimuth {
namespace {

// Of poses.
constexpr std::array<WantedColumn, 12> kPose{{{"t_s"},
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
                                              {"right_rad", false}}};
constexpr std::size_t kT = 0, kX = 1, kY = 2, kHeading = 3, kQx = 4, kQy = 5, kQz = 6, kQw = 7, kLeft = 8, kRight = 9,
                      kLeftAngle = 10, kRightAngle = 11, kTruthColumns = 8;

bool is_plausible_component(double q) { return std::abs(q) <= 1.01; }
bool is_plausible_wheel_angle(double angle_rad) { return std::abs(angle_rad) <= kMaxCoordinate_m; }

/// Walks `table` row by row: `use(reader)` for each, after `check(reader)` has found nothing missing, which it says in
/// words.
template <class Rows, class Check, class Use>
FileResult<Rows> read_rows(const ForeignText& table, std::span<const WantedColumn> wanted, Check check, Use use) {
  const FileResult<std::vector<ForeignColumn>> columns = parse_columns(table.columns, wanted, table.option);
  if (!columns) return failure(columns.error());
  FileErrorList errors(table.file);
  ForeignTable reader(table.text, wanted, *columns, table.option, errors);
  if (std::string missing = errors.empty() ? check(reader) : std::string(); !missing.empty())
    errors.add(0, std::move(missing) + "; " + reader.columns_there());
  Rows rows;
  const bool readable = errors.empty();
  while (readable && reader.next()) use(reader, rows);
  if (rows.empty() && errors.empty()) errors.add(0, "has no rows");
  FileErrors all;
  std::move(errors).move_to(all);
  if (!all.empty()) return failure(std::move(all));
  return rows;
}

/// The heading by either way; nothing: an error was added.
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

std::optional<Pose2> read_pose(ForeignTable& reader) {
  const auto x_m = reader.number(kX, is_plausible_coordinate);
  const auto y_m = reader.number(kY, is_plausible_coordinate);
  const auto heading_rad = read_heading(reader);
  if (!x_m || !y_m || !heading_rad) return std::nullopt;
  return Pose2{*x_m, *y_m, wrap(*heading_rad)};
}

/// Poses by wheels, where the table has no others.
class WheelReader {
 public:
  explicit WheelReader(const Wheels& wheels) : wheels_(wheels), path_(wheels.track_m) {}

  std::optional<Pose2> read(ForeignTable& reader) {
    const bool angles = !reader.has(kLeft);
    const auto fits = angles ? is_plausible_wheel_angle : is_plausible_coordinate;
    const auto left = reader.number(angles ? kLeftAngle : kLeft, fits);
    const auto right = reader.number(angles ? kRightAngle : kRight, fits);
    if (!left || !right) return std::nullopt;
    const double metres = angles ? wheels_.radius_m : 1.0;
    return path_.at(*left * metres, *right * metres);
  }

 private:
  Wheels wheels_;
  WheelPath path_;
};

bool has_pose(const ForeignTable& reader) {
  const bool turns = reader.has(kHeading) || (reader.has(kQz) && reader.has(kQw));
  return reader.has(kX) && reader.has(kY) && turns;
}

/// What a table lacks for poses, in words; empty: nothing.
std::string lacks_pose(const ForeignText& table, const ForeignTable& reader) {
  if (has_pose(reader)) return {};
  std::string lacks;
  if (!reader.has(kX)) lacks += "x_m, ";
  if (!reader.has(kY)) lacks += "y_m, ";
  if (!reader.has(kHeading) && !(reader.has(kQz) && reader.has(kQw))) lacks += "heading_rad (or qz and qw), ";
  lacks.resize(lacks.size() - 2);
  return "nothing says which column is " + lacks + ": " + table.option + " t_s=COLUMN,x_m=COLUMN,...";
}

std::string lacks_odometry(const ForeignText& table, const ForeignTable& reader, const Wheels& wheels) {
  const bool distances = reader.has(kLeft) && reader.has(kRight);
  const bool angles = reader.has(kLeftAngle) && reader.has(kRightAngle);
  if (has_pose(reader) || (!distances && !angles)) return lacks_pose(table, reader);
  if (!(wheels.track_m > 0.0)) return "wheels need the distance between them: --track METRES";
  if (!distances && !(wheels.radius_m > 0.0)) return "angles of wheels need their radius: --wheel-radius METRES";
  return {};
}

/// Whether the row is to be kept: it has a stamp, later than that of the row above.
bool is_new(ForeignTable& reader, const std::optional<Stamp>& stamp, std::uint64_t& repeated) {
  if (!stamp) return false;
  const ForeignTable::Order order = reader.order(*stamp);
  if (order == ForeignTable::Order::same) ++repeated;
  return order == ForeignTable::Order::later;
}

// Columns of bearings.
constexpr std::array<WantedColumn, 8> kBearing{{{"t_s"},
                                                {"azimuth_rad"},
                                                {"elevation_rad", false},
                                                {"landmark_id", false},
                                                {"kind", false},
                                                {"sigma_rad", false},
                                                {"radius_px", false},
                                                {"sigma_elevation_rad", false}}};

/// The number in an optional column into `value`, which stays as it is when the field is empty; false: it is wrong.
bool read_number(ForeignTable& reader, std::size_t column, bool (*fits)(double), double& value) {
  if (reader.field(column).empty()) return true;
  const std::optional<double> number = reader.number(column, fits);
  value = number.value_or(value);
  return number.has_value();
}

template <class Integer>
bool read_integer(ForeignTable& reader, std::size_t column, bool (*fits)(std::int64_t), Integer& value) {
  if (reader.field(column).empty()) return true;
  const std::optional<std::int64_t> number = reader.integer(column, fits);
  if (number) value = static_cast<Integer>(*number);
  return number.has_value();
}

std::optional<Bearing> read_bearing(ForeignTable& reader) {
  Bearing bearing;
  const std::optional<double> azimuth_rad = reader.number(1, is_plausible_azimuth);
  bool good = azimuth_rad.has_value();
  if (good) bearing.azimuth_rad = wrap(*azimuth_rad);
  good = read_number(reader, 2, is_plausible_elevation, bearing.elevation_rad) && good;
  good = read_integer(reader, 3, is_plausible_identity, bearing.identity) && good;
  good = read_integer(reader, 4, is_plausible_kind, bearing.kind) && good;
  good = read_number(reader, 5, is_plausible_bearing_sigma, bearing.sigma_rad) && good;
  good = read_number(reader, 6, is_plausible_radius, bearing.radius_px) && good;
  good = read_number(reader, 7, is_plausible_bearing_sigma, bearing.sigma_elevation_rad) && good;
  return good ? std::optional(bearing) : std::nullopt;
}

}  // namespace

FileResult<std::vector<OdometryReading>> foreign_odometry(const ForeignText& table, const Wheels& wheels,
                                                          std::uint64_t& repeated) {
  using Rows = std::vector<OdometryReading>;
  WheelReader by_wheels(wheels);
  const auto check = [&](const ForeignTable& reader) { return lacks_odometry(table, reader, wheels); };
  return read_rows<Rows>(table, kPose, check, [&](ForeignTable& reader, Rows& rows) {
    const std::optional<Stamp> stamp = reader.stamp(kT);
    const std::optional<Pose2> pose = has_pose(reader) ? read_pose(reader) : by_wheels.read(reader);
    if (!is_new(reader, stamp, repeated) || !pose) return;
    rows.push_back({.stamp = *stamp, .sequence = rows.size(), .origin = 0, .T_odom_body = *pose});
  });
}

FileResult<std::vector<TruthPose>> foreign_truth(const ForeignText& table, std::uint64_t& repeated) {
  using Rows = std::vector<TruthPose>;
  const auto check = [&](const ForeignTable& reader) { return lacks_pose(table, reader); };
  return read_rows<Rows>(table, std::span(kPose).first(kTruthColumns), check, [&](ForeignTable& reader, Rows& rows) {
    const std::optional<Stamp> stamp = reader.stamp(kT);
    const std::optional<Pose2> pose = read_pose(reader);
    if (!is_new(reader, stamp, repeated) || !pose) return;
    rows.push_back({.stamp = *stamp, .T_world_body = *pose});
  });
}

FileResult<std::vector<BearingSet>> foreign_bearings(const ForeignText& table) {
  using Rows = std::vector<BearingSet>;
  const auto nothing_lacks = [](const ForeignTable&) { return std::string(); };
  return read_rows<Rows>(table, kBearing, nothing_lacks, [](ForeignTable& reader, Rows& sets) {
    const std::optional<Stamp> stamp = reader.stamp(0);
    const std::optional<Bearing> bearing = read_bearing(reader);
    if (!stamp) return;
    if (reader.order(*stamp) == ForeignTable::Order::later)
      sets.push_back({.stamp = *stamp, .sequence = sets.size(), .bearings = {}});
    if (bearing && !sets.empty()) sets.back().bearings.push_back(*bearing);
  });
}

FileResult<std::vector<StampedFile>> foreign_files(const ForeignText& table) {
  static constexpr std::array<WantedColumn, 2> kFile{{{"t_s"}, {"file"}}};
  using Rows = std::vector<StampedFile>;
  const auto nothing_lacks = [](const ForeignTable&) { return std::string(); };
  return read_rows<Rows>(table, kFile, nothing_lacks, [](ForeignTable& reader, Rows& rows) {
    const std::optional<Stamp> stamp = reader.stamp(0);
    if (reader.field(1).empty()) reader.fail("file is empty");
    if (!stamp) return;
    const ForeignTable::Order order = reader.order(*stamp);
    if (order == ForeignTable::Order::same) reader.fail("t_s is that of the row above");
    if (order == ForeignTable::Order::later) rows.push_back({*stamp, std::string(reader.field(1)), reader.line()});
  });
}

}  // namespace azimuth
