#pragma once
// Reads the samples of a run from tables of other programs. Errors name the file, line and column. A row that repeats
// the stamp of the row above is left out and counted; an earlier stamp is an error.
//
// Thread contract: reentrant.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_result.hpp"
#include "drivers/wire/truth.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/odometry.hpp"
#include "tools/import/wheel_path.hpp"

namespace azimuth {

/// A table and the assignment of its columns.
struct ForeignText {
  std::string_view text;
  std::string file;     ///< file name for errors
  std::string columns;  ///< see parse_columns(); empty: columns have the names of run folders
  std::string option;   ///< name of the option that gives `columns`, for errors
};

/// Notes for the user on a table that was read.
struct TableNotes {
  std::uint64_t repeated = 0;  ///< number of rows left out because they repeat the stamp of the row above
  std::vector<std::string> sentences;
};

/// Reads odometry from the column t_s and one of these groups: x_m, y_m and heading_rad or the quaternion qz, qw (with
/// optional qx, qy); the rolled distances left_m, right_m (needs wheels.track_m); the wheel angles left_rad, right_rad
/// (needs wheels.track_m and wheels.radius_m); or speed_m_s and turn_rad_s, which are integrated. Where the odometer
/// restarts, readings get another origin (part_at_jumps()).
FileResult<std::vector<OdometryReading>> foreign_odometry(const ForeignText& table, const Wheels& wheels,
                                                          TableNotes& notes);

/// Reads truth from the columns t_s, x_m, y_m and, if known, heading_rad or a quaternion.
FileResult<std::vector<TruthPose>> foreign_truth(const ForeignText& table, TableNotes& notes);

/// Reads bearings from the columns t_s, azimuth_rad and the optional columns of bearings.csv. Rows with the same stamp
/// belong to the same image.
FileResult<std::vector<BearingSet>> foreign_bearings(const ForeignText& table, TableNotes& notes);

/// A row of a table of images.
struct StampedFile {
  Stamp stamp{};
  std::string file;  ///< file name as in the table
  int line = 0;
};

/// Reads the columns t_s and file.
FileResult<std::vector<StampedFile>> foreign_files(const ForeignText& table);

}  // namespace azimuth
