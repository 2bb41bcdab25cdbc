#include "tools/import/foreign_rows.hpp"

#include "drivers/wire/number_text.hpp"

namespace azimuth {
namespace {

/// Monotonicity of a column from row to row.
struct Course {
  bool grows_within = false, falls_within = false;  // among rows with the same stamp
  bool falls = false;                               // between any two rows
  double above = 0.0;

  void add(std::optional<double> value, bool is_first, bool is_same_stamp) {
    const double step = value.value_or(0.0) - std::exchange(above, value.value_or(0.0));
    grows_within = grows_within || (is_same_stamp && step > 0.0);
    falls_within = falls_within || !value || (is_same_stamp && step < 0.0);
    falls = falls || (!is_first && step < 0.0);
  }
};

std::vector<Course> courses_of(ForeignTable& reader) {
  std::vector<Course> all(reader.width());
  bool is_first = true;
  std::string stamp;
  while (reader.next()) {
    const bool is_same = !is_first && reader.field(0) == stamp;
    for (std::size_t i = 0; i < all.size(); ++i) all[i].add(parse_double(reader.any_field(i)), is_first, is_same);
    stamp = reader.field(0);
    is_first = false;
  }
  return all;
}

}  // namespace

std::string finer_stamps(const ForeignText& table, std::span<const WantedColumn> wanted,
                         const std::vector<ForeignColumn>& columns) {
  FileErrorList ignored(table.file);
  ForeignTable reader(table.text, wanted, columns, table.option, ignored);
  const std::vector<Course> courses = courses_of(reader);
  for (std::size_t i = 0; i < courses.size(); ++i) {
    if (!courses[i].grows_within || courses[i].falls_within || reader.is_asked_for(i)) continue;
    const std::string name = reader.name_of(i);
    return "; column " + name + " goes on within them: " + table.option +
           " t_s=" + (courses[i].falls ? columns.front().name + '+' + name : name);
  }
  return "; no column goes on within them: record finer stamps";
}

}  // namespace azimuth
