#pragma once
// Reads tables of any content row by row. Internal to tools/import.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tools/import/foreign_samples.hpp"
#include "tools/import/foreign_table.hpp"

namespace azimuth {

/// End of an error message: suggests a column that distinguishes rows with the same stamp, and the option to use it.
std::string finer_stamps(const ForeignText& table, std::span<const WantedColumn> wanted,
                         const std::vector<ForeignColumn>& columns);

/// Filters rows that repeat the stamp of the row above.
class RepeatedStamps {
 public:
  /// True if the row has a later stamp than the row above. `values`: the other values of the row.
  bool keeps(ForeignTable& reader, const std::optional<Stamp>& stamp, const std::array<double, 3>& values) {
    if (!stamp) return false;
    ++rows_;
    const ForeignTable::Order order = reader.order(*stamp);
    const bool is_same = std::exchange(above_, values) == values;
    if (order == ForeignTable::Order::same) ++(is_same ? repeated_ : contradicting_);
    return order == ForeignTable::Order::later;
  }
  std::uint64_t count() const { return repeated_ + contradicting_; }

  /// Error text if too many rows have the same stamp but other values than the row above; otherwise empty.
  std::string problem() const {
    constexpr std::uint64_t kOneIn = 4, kEnough = 5;
    if (contradicting_ < kEnough || kOneIn * contradicting_ <= rows_) return {};
    return std::to_string(contradicting_) + " of " + std::to_string(rows_) +
           " rows have the stamp of the row above and other values: stamps in whole seconds, perhaps";
  }

 private:
  std::uint64_t rows_ = 0, repeated_ = 0, contradicting_ = 0;
  std::array<double, 3> above_{};
};

/// Reads `table` row by row. `check(reader)` returns the missing columns as text. If nothing is missing, `use(reader,
/// rows)` is called for each row. At the end, `judge(reader, rows)` returns an error text about the stamps, or an empty
/// text.
template <class Rows, class Check, class Use, class Judge>
FileResult<Rows> read_rows(const ForeignText& table, std::span<const WantedColumn> wanted, Check check, Use use,
                           Judge judge) {
  const FileResult<std::vector<ForeignColumn>> columns = parse_columns(table.columns, wanted, table.option);
  if (!columns) return failure(columns.error());
  FileErrorList errors(table.file);
  ForeignTable reader(table.text, wanted, *columns, table.option, errors);
  if (std::string missing = errors.empty() ? check(reader) : std::string(); !missing.empty())
    errors.add(0, std::move(missing) + "; " + reader.columns_there());
  Rows rows;
  const bool readable = errors.empty();
  while (readable && reader.next()) use(reader, rows);
  if (rows.empty() && errors.empty()) errors.add(0, "has no rows");
  const std::string problem = errors.empty() ? judge(reader, rows) : std::string();
  if (!problem.empty()) errors.add(0, problem + finer_stamps(table, wanted, *columns));
  FileErrors all;
  std::move(errors).move_to(all);
  if (!all.empty()) return failure(std::move(all));
  return rows;
}

}  // namespace azimuth
