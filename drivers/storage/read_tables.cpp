#include <algorithm>
#include <array>
#include <azimuth/features_t.hpp>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <unordered_set>
#include <utility>

#include "drivers/storage/csv_reader.hpp"
#include "drivers/storage/tables.hpp"
#include "drivers/wire/plausible.hpp"
#include "slam/sample/odometry_steps.hpp"

namespace azimuth {

namespace {

/// Compares each stamp with that of the previous row.
class StampOrder {
 public:
  enum class Row { later, same, earlier };

  /// Reports an earlier stamp as an error in the reader's current row.
  Row check(Stamp stamp, CsvReader& reader) {
    const std::optional<Stamp> above = std::exchange(above_, stamp);
    if (!above || stamp > *above) return Row::later;
    if (stamp == *above) return Row::same;
    reader.fail("t_s is earlier than in the row above");
    return Row::earlier;
  }

 private:
  std::optional<Stamp> above_;
};

void require_rows(bool any, FileErrorList& errors) {
  if (!any && errors.empty()) errors.add(0, "has no rows");
}

/// Reads rows of t_s,x_m,y_m,heading_rad and further columns, made by `make_row(stamp, pose, index, reader)`.
template <class MakeRow>
auto read_poses(const TableText& table, std::span<const CsvColumn> columns, FileErrors& all_errors,
                std::uint64_t& skipped, MakeRow make_row) {
  FileErrorList errors(table.file);
  CsvReader reader(table.text, columns, errors);
  StampOrder order;
  std::vector<decltype(make_row(Stamp{}, Pose2{}, std::size_t{}, reader))> rows;
  while (reader.next()) {
    const auto stamp = reader.seconds(0);
    const auto x_m = reader.number(1, is_plausible_coordinate);
    const auto y_m = reader.number(2, is_plausible_coordinate);
    const auto heading_rad = reader.has(3) ? reader.number(3, is_plausible_heading)
                                           : std::optional(std::numeric_limits<double>::quiet_NaN());
    const auto row = stamp ? order.check(*stamp, reader) : StampOrder::Row::earlier;
    if (row == StampOrder::Row::same) ++skipped;
    if (row != StampOrder::Row::later || !x_m || !y_m || !heading_rad) continue;
    rows.push_back(make_row(*stamp, Pose2{*x_m, *y_m, wrap(*heading_rad)}, rows.size(), reader));
  }
  require_rows(!rows.empty(), errors);
  std::move(errors).move_to(all_errors);
  return rows;
}

// Optional columns of odometry.csv.
constexpr std::size_t kOrigin = 4, kSigmaGap = 5, kSigmaGapTurn = 6;

bool is_origin(std::int64_t origin) { return origin >= 0 && origin <= std::numeric_limits<std::uint32_t>::max(); }

// Columns of bearings.csv.
constexpr std::size_t kStamp = 0, kAzimuth = 1, kElevation = 2, kLandmark = 3, kKind = 4, kSigma = 5, kRadius = 6,
                      kSigmaElevation = 7;

/// Largest number in one set, because a message in a log cannot hold more.
constexpr std::size_t kMostBearings = features_t::MAX_FEATURES;

/// None when a field is wrong.
std::optional<Bearing> read_bearing(CsvReader& reader) {
  Bearing bearing;
  const auto azimuth_rad = reader.number(kAzimuth, is_plausible_azimuth);
  bool good = azimuth_rad.has_value();
  if (good) bearing.azimuth_rad = wrap(*azimuth_rad);
  if (!reader.field(kElevation).empty()) {
    const auto elevation_rad = reader.number(kElevation, is_plausible_elevation);
    good = good && elevation_rad;
    bearing.elevation_rad = elevation_rad.value_or(bearing.elevation_rad);
  }
  if (!reader.field(kLandmark).empty()) {
    const auto identity = reader.integer(kLandmark, is_plausible_identity);
    good = good && identity;
    bearing.identity = identity.value_or(kUnknownIdentity);
  }
  if (!reader.field(kKind).empty()) {
    const auto kind = reader.integer(kKind, is_plausible_kind);
    good = good && kind;
    bearing.kind = static_cast<Kind>(kind.value_or(kAnyKind));
  }
  if (!reader.field(kSigma).empty()) {
    const auto sigma_rad = reader.number(kSigma, is_plausible_bearing_sigma);
    good = good && sigma_rad;
    bearing.sigma_rad = sigma_rad.value_or(bearing.sigma_rad);
  }
  if (!reader.field(kRadius).empty()) {
    const auto radius_px = reader.number(kRadius, is_plausible_radius);
    good = good && radius_px;
    bearing.radius_px = radius_px.value_or(bearing.radius_px);
  }
  if (!reader.field(kSigmaElevation).empty()) {
    const auto sigma_rad = reader.number(kSigmaElevation, is_plausible_bearing_sigma);
    good = good && sigma_rad;
    bearing.sigma_elevation_rad = sigma_rad.value_or(bearing.sigma_elevation_rad);
  }
  return good ? std::optional(bearing) : std::nullopt;
}

/// Why the row's set is empty; none when it has a bearing.
std::optional<ImageTrouble> empty_set_word(const CsvReader& reader) {
  const auto word = std::ranges::find(kEmptySetWords, reader.field(kAzimuth));
  if (word == kEmptySetWords.end()) return std::nullopt;
  return static_cast<ImageTrouble>(word - kEmptySetWords.begin());
}

/// Adds the row to the last set. `is_empty_set` tells that the set's first row marks it as empty.
void add_bearing(CsvReader& reader, bool first_of_set, bool& is_empty_set, BearingSet& set) {
  const std::optional<ImageTrouble> nothing_found = empty_set_word(reader);
  const auto is_empty = [&reader](std::size_t column) { return reader.field(column).empty(); };
  if (first_of_set) is_empty_set = nothing_found.has_value();
  if (!nothing_found) {
    if (is_empty_set) return reader.fail("bearings beside azimuth_rad none of equal t_s");
    if (set.bearings.size() == kMostBearings)
      return reader.fail("more than " + std::to_string(kMostBearings) +
                         " bearings of equal t_s: no image shows so many");
    if (const auto bearing = read_bearing(reader)) set.bearings.push_back(*bearing);
  } else if (!first_of_set) {
    reader.fail("azimuth_rad " + std::string(reader.field(kAzimuth)) + " beside other rows of equal t_s");
  } else if (!std::ranges::all_of(std::array{kElevation, kLandmark, kKind, kSigma}, is_empty)) {
    reader.fail("azimuth_rad " + std::string(reader.field(kAzimuth)) + " with further values");
  } else {
    set.trouble = *nothing_found;
  }
}

/// True: the path cannot lead out of its folder.
bool is_below_folder(std::string_view file) {
  const std::filesystem::path path(file);
  return !file.empty() && path.is_relative() && std::ranges::find(path, "..") == path.end();
}

}  // namespace

bool fits_field(std::string_view text) {
  return std::ranges::none_of(text,
                              [](char c) { return c == ',' || static_cast<unsigned char>(c) < ' ' || c == '\x7F'; });
}

std::vector<OdometryReading> read_odometry_table(const TableText& table, FileErrors& errors, std::uint64_t& skipped) {
  static constexpr std::array<CsvColumn, 7> kColumns{{{"t_s"},
                                                      {"x_m"},
                                                      {"y_m"},
                                                      {"heading_rad"},
                                                      {"origin", false},
                                                      {"sigma_gap_m", false},
                                                      {"sigma_gap_rad", false}}};
  bool says_origin = false;
  auto readings = read_poses(
      table, kColumns, errors, skipped, [&](Stamp stamp, const Pose2& pose, std::size_t index, CsvReader& reader) {
        says_origin = reader.has(kOrigin);
        return OdometryReading{.stamp = stamp,
                               .sequence = index,
                               .origin = static_cast<std::uint32_t>(reader.integer(kOrigin, is_origin).value_or(0)),
                               .T_odom_body = pose,
                               .sigma_gap_m = reader.number(kSigmaGap, is_plausible_sigma).value_or(0.0),
                               .sigma_gap_rad = reader.number(kSigmaGapTurn, is_plausible_sigma).value_or(0.0)};
      });
  if (!says_origin) part_at_jumps(readings);
  return readings;
}

std::vector<TruthPose> read_truth_table(const TableText& table, FileErrors& errors, std::uint64_t& skipped) {
  static constexpr std::array<CsvColumn, 4> kColumns{{{"t_s"}, {"x_m"}, {"y_m"}, {"heading_rad", false}}};
  return read_poses(table, kColumns, errors, skipped, [](Stamp stamp, const Pose2& pose, std::size_t, CsvReader&) {
    return TruthPose{.stamp = stamp, .T_world_body = pose};
  });
}

std::vector<BearingSet> read_bearings_table(const TableText& table, FileErrors& all_errors) {
  static constexpr std::array<CsvColumn, 8> kColumns{{{"t_s"},
                                                      {"azimuth_rad"},
                                                      {"elevation_rad", false},
                                                      {"landmark_id", false},
                                                      {"kind", false},
                                                      {"sigma_rad", false},
                                                      {"radius_px", false},
                                                      {"sigma_elevation_rad", false}}};
  FileErrorList errors(table.file);
  CsvReader reader(table.text, kColumns, errors);
  StampOrder order;
  bool is_empty_set = false;
  std::vector<BearingSet> sets;
  while (reader.next()) {
    const auto stamp = reader.seconds(kStamp);
    const auto row = stamp ? order.check(*stamp, reader) : StampOrder::Row::earlier;
    if (row == StampOrder::Row::later) sets.push_back({.stamp = *stamp, .sequence = sets.size(), .bearings = {}});
    if (!sets.empty()) add_bearing(reader, row != StampOrder::Row::same, is_empty_set, sets.back());
  }
  require_rows(!sets.empty(), errors);
  std::move(errors).move_to(all_errors);
  return sets;
}

std::vector<FrameFile> read_frames_table(const TableText& table, FileErrors& all_errors) {
  static constexpr std::array<CsvColumn, 2> kColumns{{{"t_s"}, {"file"}}};
  FileErrorList errors(table.file);
  CsvReader reader(table.text, kColumns, errors);
  StampOrder order;
  std::vector<FrameFile> frames;
  while (reader.next()) {
    const auto stamp = reader.seconds(0);
    if (!is_below_folder(reader.field(1)) || !fits_field(reader.field(1))) {
      reader.fail("file is not a path below the run folder");
    }
    if (!stamp) continue;
    if (order.check(*stamp, reader) == StampOrder::Row::same) reader.fail("t_s is that of the row above");
    frames.push_back({*stamp, std::string(reader.field(1))});
  }
  require_rows(!frames.empty(), errors);
  std::move(errors).move_to(all_errors);
  return frames;
}

std::vector<TrueLandmark> read_landmarks_table(const TableText& table, FileErrors& all_errors) {
  static constexpr std::array<CsvColumn, 5> kColumns{
      {{"landmark_id"}, {"x_m"}, {"y_m"}, {"z_m", false}, {"kind", false}}};
  FileErrorList errors(table.file);
  CsvReader reader(table.text, kColumns, errors);
  std::unordered_set<Identity> known;
  std::vector<TrueLandmark> landmarks;
  while (reader.next()) {
    const auto identity = reader.integer(0, [](Identity id) { return id >= 0; });
    const auto x_m = reader.number(1, is_plausible_coordinate);
    const auto y_m = reader.number(2, is_plausible_coordinate);
    TrueLandmark landmark;
    if (!reader.field(3).empty()) landmark.z_m = reader.number(3, is_plausible_coordinate).value_or(0.0);
    if (!fits_field(reader.field(4))) reader.fail("kind has control characters");
    if (!identity || !x_m || !y_m) continue;
    if (!known.insert(*identity).second) reader.fail("landmark_id " + std::to_string(*identity) + " is repeated");
    landmark.identity = *identity;
    landmark.x_m = *x_m;
    landmark.y_m = *y_m;
    landmark.kind = reader.field(4);
    landmarks.push_back(std::move(landmark));
  }
  require_rows(!landmarks.empty(), errors);
  std::move(errors).move_to(all_errors);
  return landmarks;
}

}  // namespace azimuth
