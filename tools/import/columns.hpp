#pragma once
// Assigns the columns of a foreign table to values, with units, as the option --columns specifies.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_result.hpp"

namespace azimuth {

/// A value that is read from a table. Its name ends in its unit, as in run folders: t_s, x_m, heading_rad.
struct WantedColumn {
  std::string_view name;
  bool required = true;
};

/// The column of a value, and its unit.
struct ForeignColumn {
  std::string name;       ///< name in the header, or a number that counts from 1
  bool given = false;     ///< the user gave the column; otherwise `name` is the name of the value
  double factor = 1.0;    ///< value = factor * content of the column; not used for stamps
  int digits = 0;         ///< for stamps: number of digits that are fractions of a second; 9 for nanoseconds
  std::string rest = {};  ///< for stamps in two columns: the second one, with the fractions; empty if there is none
  int rest_digits = 9;    ///< like `digits`, for `rest`
  std::string unit = {};  ///< unit as written; empty: the unit in the value's name
};

/// Parses `VALUE=[-]COLUMN[UNIT],...`, for example t_s=stamp[ns],x_m=px,heading_rad=-yaw[deg]. A minus sign inverts the
/// sign of the value. Units are s, ms, us, ns; m, cm, mm, km; rad, deg; for speeds m/s, cm/s, mm/s, km/h, rad/s, deg/s;
/// or a number by which the column is multiplied. t_s=SECONDS+NANOSECONDS is a stamp in two columns. Returns one entry
/// for each of `wanted`, in the same order. Values that `text` does not mention have their own name as the column's
/// name. Errors name `option`. Reentrant.
FileResult<std::vector<ForeignColumn>> parse_columns(std::string_view text, std::span<const WantedColumn> wanted,
                                                     const std::string& option);

/// Applies a unit from the header of the table. Returns false if the unit does not fit the value. Reentrant.
bool take_unit(std::string_view value, std::string_view unit, ForeignColumn& column);

/// Number of decimal digits of a second in a unit of time, for example 9 for ns; nothing for other words.
std::optional<int> digits_of_time(std::string_view unit);

}  // namespace azimuth
