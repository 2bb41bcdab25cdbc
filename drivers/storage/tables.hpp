#pragma once
// The tables of a run folder as text. Internal to drivers/storage.
//
// A reading function appends what is wrong to `errors`; its rows are of use only if it appended nothing. Rows that
// repeat the stamp of the row above are left out and counted; a stamp earlier than that of the row above is an error,
// and so is a table without rows.

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
  std::string file;  ///< how errors name it
};

/// t_s,x_m,y_m,heading_rad[,origin][,sigma_gap_m][,sigma_gap_rad]: where no column says the origin, readings get
/// another one after each step that no wheels make (part_at_jumps()).
std::vector<OdometryReading> read_odometry_table(const TableText& table, FileErrors& errors, std::uint64_t& skipped);
/// t_s,x_m,y_m[,heading_rad]: NaN where it is not known
std::vector<TruthPose> read_truth_table(const TableText& table, FileErrors& errors, std::uint64_t& skipped);

/// t_s,azimuth_rad[,elevation_rad][,landmark_id][,kind][,sigma_rad][,radius_px][,sigma_elevation_rad]: rows of equal
/// t_s make one set. A word of kEmptySetWords for the azimuth, all further fields empty, stands for an image without
/// bearings; an empty elevation was not measured; landmark and kind are unknown when they are -1 or empty; an empty
/// sigma is the rig's, an empty radius not known.
std::vector<BearingSet> read_bearings_table(const TableText& table, FileErrors& errors);

/// t_s,file: paths below the folder
std::vector<FrameFile> read_frames_table(const TableText& table, FileErrors& errors);

/// landmark_id,x_m,y_m[,z_m][,kind]: an empty z_m is not known
std::vector<TrueLandmark> read_landmarks_table(const TableText& table, FileErrors& errors);

// The reading functions give equal values back, bit for bit. Optional columns are there if a row needs them.
std::string odometry_table(std::span<const OdometryReading> readings);
std::string truth_table(std::span<const TruthPose> poses);
std::string bearings_table(std::span<const BearingSet> sets);
std::string frames_table(std::span<const FrameFile> frames);
std::string landmarks_table(std::span<const TrueLandmark> landmarks);

/// Why a set is empty, by its ImageTrouble; none: nothing was found.
inline constexpr std::array<std::string_view, kImageTroubles> kEmptySetWords{
    "none", "unreadable", "dark", "overexposed", "featureless", "frozen", "torn"};

/// Whether bearings_table() can say all of the set: no descriptors or neighbours, and no bearings beside trouble.
bool fits_table(const BearingSet& set);

/// Whether a field can hold `text`: no commas, no control characters.
bool fits_field(std::string_view text);

}  // namespace azimuth
