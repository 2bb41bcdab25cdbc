// Any text as each table of a run folder. The result must be errors or rows, and rows must survive writing and reading.
// The first byte selects the table.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "drivers/storage/tables.hpp"

namespace azimuth {
namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

/// `read(text, errors)` returns rows, `write(rows)` returns a table.
template <class Read, class Write>
void check(std::string_view text, Read read, Write write) {
  FileErrors errors;
  const auto rows = read(TableText{text, "table.csv"}, errors);
  require(errors.size() <= FileErrorList::kMost + 1);
  if (!errors.empty()) return;
  require(!rows.empty());
  const std::string table = write(rows);
  const auto back = read(TableText{table, "table.csv"}, errors);
  require(errors.empty());
  require(write(back) == table);
  require(back.size() == rows.size());
}

template <class Read>
auto without_count(Read read) {
  return [read](const TableText& table, FileErrors& errors) {
    std::uint64_t skipped = 0;
    return read(table, errors, skipped);
  };
}

void check_table(unsigned table, std::string_view text) {
  switch (table % 5) {
    case 0:
      check(text, without_count(read_odometry_table), odometry_table);
      break;
    case 1:
      check(text, without_count(read_truth_table), truth_table);
      break;
    case 2:
      check(text, read_bearings_table, bearings_table);
      break;
    case 3:
      check(text, read_frames_table, frames_table);
      break;
    case 4:
      check(text, read_landmarks_table, landmarks_table);
      break;
  }
}

}  // namespace
}  // namespace azimuth

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 0) azimuth::check_table(data[0], {reinterpret_cast<const char*>(data) + 1, size - 1});
  return 0;
}
