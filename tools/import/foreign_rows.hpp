#pragma once
// How tables are read row by row, whatever is in them. Internal to tools/import.

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

/// Which column tells rows of one stamp apart, and the option that says so, as the end of a sentence.
std::string finer_stamps(const ForeignText& table, std::span<const WantedColumn> wanted,
                         const std::vector<ForeignColumn>& columns);

/// Rows that repeat the stamp of the row above.
class RepeatedStamps {
 public:
  /// Whether the row is to be kept: it has a stamp, later than that of the row above. `values`: what else it says.
  bool keeps(ForeignTable& reader, const std::optional<Stamp>& stamp, const std::array<double, 3>& values) {
    if (!stamp) return false;
    ++rows_;
    const ForeignTable::Order order = reader.order(*stamp);
    const bool is_same = std::exchange(above_, values) == values;
    if (order == ForeignTable::Order::same) ++(is_same ? repeated_ : contradicting_);
    return order == ForeignTable::Order::later;
  }
  std::uint64_t count() const { return repeated_ + contradicting_; }

  /// Too many say something else at one and the same time for chance; empty: they do not.
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

/// Walks `table` row by row: `use(reader)` for each, after `check(reader)` has found nothing missing, which it says in
/// words. What `judge(reader, rows)` says at the end is wrong with the stamps.
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
