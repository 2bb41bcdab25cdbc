#pragma once
// The tables of a run folder as text. Internal to drivers/storage.
//
// A reading function appends errors to `errors`; its rows are valid only if it appended none. Rows that repeat the
// stamp of the previous row are left out and counted. A stamp earlier than that of the previous row is an error, and so
// is a table without rows.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_result.hpp"
#include "drivers/storage/run.hpp"

namespace azimuth {

struct TableText {
  std::string_view text;
  std::string file;  ///< name of the table in errors
};

/// t_s,x_m,y_m,heading_rad[,origin][,sigma_gap_m][,sigma_gap_rad]. Without an origin column, the origin changes after
/// each step that wheels cannot make (part_at_jumps()).
std::vector<OdometryReading> read_odometry_table(const TableText& table, FileErrors& errors, std::uint64_t& skipped);
/// t_s,x_m,y_m[,heading_rad]: NaN for an unknown heading
std::vector<TruthPose> read_truth_table(const TableText& table, FileErrors& errors, std::uint64_t& skipped);

/// t_s,azimuth_rad[,elevation_rad][,landmark_id][,kind][,sigma_rad][,radius_px][,sigma_elevation_rad]: rows of equal
/// t_s make one set. A word of kEmptySetWords as the azimuth, with all further fields empty, means an image without
/// bearings. An empty elevation was not measured; landmark and kind are unknown when they are -1 or empty; an empty
/// sigma means the rig's value; an empty radius is unknown.
std::vector<BearingSet> read_bearings_table(const TableText& table, FileErrors& errors);

/// t_s,file: paths relative to the folder
std::vector<FrameFile> read_frames_table(const TableText& table, FileErrors& errors);

/// landmark_id,x_m,y_m[,z_m][,kind]: an empty z_m is unknown
std::vector<TrueLandmark> read_landmarks_table(const TableText& table, FileErrors& errors);

// The functions below write tables. The reading functions return equal values, bit for bit. Optional columns are
// written only if a row needs them.
std::string odometry_table(std::span<const OdometryReading> readings);
std::string truth_table(std::span<const TruthPose> poses);
std::string bearings_table(std::span<const BearingSet> sets);
std::string frames_table(std::span<const FrameFile> frames);
std::string landmarks_table(std::span<const TrueLandmark> landmarks);

/// Why a set is empty, indexed by its ImageTrouble; "none": the image contained no bearings.
inline constexpr std::array<std::string_view, kImageTroubles> kEmptySetWords{
    "none", "unreadable", "dark", "overexposed", "featureless", "frozen", "torn"};

/// True: bearings_table() can represent the whole set. It must have no descriptors or neighbours, and no bearings
/// together with a trouble.
bool fits_table(const BearingSet& set);

/// True: a field can hold `text`, which must have no commas and no control characters.
bool fits_field(std::string_view text);

}  // namespace azimuth
