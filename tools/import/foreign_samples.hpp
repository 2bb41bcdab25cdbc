#pragma once
// The samples of a run from tables of other programs. All that is wrong with a table is named with its file, line and
// column; a stamp that repeats the one above is left out and counted, an earlier one is wrong.
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

/// A table, and what --columns says of it.
struct ForeignText {
  std::string_view text;
  std::string file;     ///< how errors name it
  std::string columns;  ///< see parse_columns(); empty: it has the names of our own
  std::string option;   ///< that says so, for errors
};

/// What is to be said of a table that was read.
struct TableNotes {
  std::uint64_t repeated = 0;  ///< rows left out, which repeat the stamp of the row above
  std::vector<std::string> sentences;
};

/// t_s, and either x_m, y_m and heading_rad or the quaternion qz, qw (and qx, qy), or how far the wheels have rolled:
/// left_m, right_m with `wheels.track_m`, or left_rad, right_rad with `wheels.radius_m` as well; or speed_m_s and
/// turn_rad_s, which are added up. Where the odometer begins anew, readings get another origin (part_at_jumps()).
FileResult<std::vector<OdometryReading>> foreign_odometry(const ForeignText& table, const Wheels& wheels,
                                                          TableNotes& notes);

/// t_s, x_m, y_m, and, if it is known, heading_rad or a quaternion.
FileResult<std::vector<TruthPose>> foreign_truth(const ForeignText& table, TableNotes& notes);

/// t_s, azimuth_rad, and what else bearings.csv may have: rows of one stamp are of one image.
FileResult<std::vector<BearingSet>> foreign_bearings(const ForeignText& table, TableNotes& notes);

/// A row of a table of images.
struct StampedFile {
  Stamp stamp{};
  std::string file;  ///< as the table has it
  int line = 0;
};

/// t_s, file.
FileResult<std::vector<StampedFile>> foreign_files(const ForeignText& table);

}  // namespace azimuth
