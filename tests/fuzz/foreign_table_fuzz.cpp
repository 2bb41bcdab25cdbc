// Any text as a table of another program, and any text as its --columns. The result must be errors with existing line
// numbers, or valid rows in the order of their stamps. The first byte selects the table; the rest of the first line are
// the columns.

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "drivers/wire/plausible.hpp"
#include "tools/import/foreign_images.hpp"
#include "tools/import/foreign_samples.hpp"
#include "tools/import/foreign_table.hpp"

namespace azimuth {
namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

template <class Rows>
void check(const ForeignText& table, const FileResult<Rows>& rows) {
  if (!rows) {
    const auto lines = 1 + std::ranges::count(table.text, '\n');
    require(!rows.error().empty());
    for (const FileError& error : rows.error()) require(error.line >= 0 && error.line <= lines);
    return;
  }
  require(!rows->empty());
  for (std::size_t i = 1; i < rows->size(); ++i) require((*rows)[i - 1].stamp < (*rows)[i].stamp);
}

void check_poses(const FileResult<std::vector<OdometryReading>>& readings) {
  if (!readings) return;
  for (const OdometryReading& reading : *readings) {
    require(std::isfinite(reading.T_odom_body.heading_rad));
    require(reading.sigma_gap_m >= 0.0 && reading.sigma_gap_rad >= 0.0);
  }
}

void check_bearings(const FileResult<std::vector<BearingSet>>& sets) {
  if (!sets) return;
  for (const BearingSet& set : *sets) {
    require(!set.bearings.empty());
    for (const Bearing& bearing : set.bearings) require(is_plausible(bearing));
  }
}

void check(unsigned table_kind, std::string_view columns, std::string_view given) {
  const std::string text = in_utf8(std::string(given));
  const ForeignText table{text, "table", std::string(columns), "--columns"};
  const Wheels wheels{.radius_m = 0.1, .track_m = 0.4};
  TableNotes notes;
  switch (table_kind % 5) {
    case 0: {
      const auto readings = foreign_odometry(table, wheels, notes);
      check(table, readings);
      check_poses(readings);
      break;
    }
    case 1:
      check(table, foreign_truth(table, notes));
      break;
    case 2: {
      const auto sets = foreign_bearings(table, notes);
      check(table, sets);
      check_bearings(sets);
      break;
    }
    case 3:
      check(table, foreign_files(table));
      break;
    case 4:
      for (const int digits : {0, 3, 6, 9}) {
        const auto stamp = stamp_in_name(text, digits);
        require(!stamp || is_plausible_stamp(to_us(*stamp)));
      }
      break;
  }
}

}  // namespace
}  // namespace azimuth

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view all(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::size_t line = std::min(all.find('\n'), all.size());
  azimuth::check(data[0], all.substr(0, line), all.substr(std::min(line + 1, all.size())));
  return 0;
}
