#pragma once
// Which column of a foreign table holds what, and in which unit: what --columns says.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/file_result.hpp"

namespace azimuth {

/// A value that a table is asked for. Its name ends in the unit it is kept in, as in run folders: t_s, x_m,
/// heading_rad.
struct WantedColumn {
  std::string_view name;
  bool required = true;
};

/// Where it stands in the table.
struct ForeignColumn {
  std::string name;       ///< as the header has it, or a number from 1
  bool given = false;     ///< somebody said so; else it is the name of the value itself
  double factor = 1.0;    ///< what stands there, times this, is the value; of other than stamps
  int digits = 0;         ///< of a stamp: so many digits are fractions of a second, 9 in nanoseconds
  std::string rest = {};  ///< of a stamp in two columns, the second one: what is beyond `name`; empty: there is none
  int rest_digits = 9;    ///< as `digits`, of that
  std::string unit = {};  ///< as it was written; empty: that of the value's name
};

/// Reads `VALUE=[-]COLUMN[UNIT],...`: t_s=stamp[ns],x_m=px,heading_rad=-yaw[deg]. A minus sign turns the value's sign.
/// Units are s, ms, us, ns; m, cm, mm, km; rad, deg; of speeds m/s, cm/s, mm/s, km/h, rad/s, deg/s; or a number that
/// the column is multiplied by. t_s=SECONDS+NANOSECONDS is a stamp in two columns. One entry for each of `wanted`, in
/// their order; those that are not mentioned stand under their own name. `option` is what errors name. Reentrant.
FileResult<std::vector<ForeignColumn>> parse_columns(std::string_view text, std::span<const WantedColumn> wanted,
                                                     const std::string& option);

/// Takes a unit that stands beside a column's name in the table itself; false: it is none of this value. Reentrant.
bool take_unit(std::string_view value, std::string_view unit, ForeignColumn& column);

/// The digits behind a second's point of a unit of time; nothing for any other word.
std::optional<int> digits_of_time(std::string_view unit);

}  // namespace azimuth
