#include "slam/association/assignment.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>
#include <utility>

#include "slam/association/fit_storage.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr double kForbidden = std::numeric_limits<double>::infinity();

}  // namespace

bool Assignment::solve(const PairingTable& table, Objective objective, std::vector<int>& column_of_row) {
  const bool transposed = table.rows > table.columns;
  load(table, objective, transposed);
  fit(alone_, rows_, kForbidden);
  const bool solved = solve_loaded();
  const std::vector<int>& taken = transposed ? row_of_ : column_of_;
  column_of_row.assign(taken.begin(), taken.end());
  return solved;
}

void Assignment::solve(const PairingTable& table, std::span<const double> alone, Objective objective,
                       std::vector<int>& column_of_row) {
  assert(alone.size() == table.rows);
  load(table, objective, false);
  fit(alone_, rows_, 0.0);
  const double sign = objective == Objective::maximise ? -1.0 : 1.0;
  std::ranges::transform(alone, alone_.begin(), [sign](double value) { return sign * value; });
  [[maybe_unused]] const bool solved = solve_loaded();
  assert(solved);
  column_of_row.assign(column_of_.begin(), column_of_.end());
}

void Assignment::load(const PairingTable& table, Objective objective, bool transposed) {
  assert(table.values.size() == table.rows * table.columns);
  rows_ = transposed ? table.columns : table.rows;
  columns_ = transposed ? table.rows : table.columns;
  fit(costs_, table.values.size());
  const double sign = objective == Objective::maximise ? -1.0 : 1.0;
  if (transposed) {
    for (std::size_t r = 0; r < rows_; ++r)
      for (std::size_t c = 0; c < columns_; ++c) costs_[r * columns_ + c] = sign * table.values[c * rows_ + r];
  } else {
    std::ranges::transform(table.values, costs_.begin(), [sign](double value) { return sign * value; });
  }
}

bool Assignment::solve_loaded() {
  fit(of_row_, rows_, 0.0);
  fit(of_column_, columns_, 0.0);
  fit(column_of_, rows_, kUnassigned);
  fit(row_of_, columns_, kUnassigned);
  take_cheapest();
  return std::ranges::all_of(waiting_, [this](int row) { return augment(row); });
}

/// Augmenting row reduction of Jonker & Volgenant: each row takes its cheapest column and raises the column's price by
/// the difference to its own second-best choice. The previous holder of that column chooses again. Few rows stay
/// unassigned.
void Assignment::take_cheapest() {
  fit(waiting_, rows_, 0);
  waiting_.clear();
  std::size_t turns = 4 * rows_;  // limit, since rows with equal costs could displace each other for ever
  for (std::size_t r = 0; r < rows_; ++r) {
    int row = static_cast<int>(r);
    while (row != kUnassigned) {
      const Choice choice = choose(row);
      of_row_[as_size(row)] = choice.cost == kForbidden ? 0.0 : choice.cost;
      if (choice.column == kUnassigned && choice.cost < kForbidden) break;  // better alone
      const bool outbids = choice.second < kForbidden && choice.second > choice.cost && turns > 0;
      if (choice.column == kUnassigned || (row_of_[as_size(choice.column)] != kUnassigned && !outbids)) {
        waiting_.push_back(row);
        break;
      }
      if (outbids) {
        --turns;
        of_column_[as_size(choice.column)] -= choice.second - choice.cost;
        of_row_[as_size(row)] = choice.second;
      }
      row = give(choice.column, row);
    }
  }
}

Assignment::Choice Assignment::choose(int row) const {
  Choice choice{alone_[as_size(row)], kForbidden, kUnassigned};
  const double* const costs = &costs_[as_size(row) * columns_];
  for (std::size_t c = 0; c < columns_; ++c) {
    const double reduced = costs[c] - of_column_[c];
    if (reduced >= choice.second) continue;
    choice.second = std::max(choice.cost, reduced);
    if (reduced >= choice.cost) continue;
    choice.cost = reduced;
    choice.column = static_cast<int>(c);
  }
  return choice;
}

/// Gives the column to the row. Returns the column's previous holder, or kUnassigned.
int Assignment::give(int column, int row) {
  const int holder = std::exchange(row_of_[as_size(column)], row);
  column_of_[as_size(row)] = column;
  if (holder != kUnassigned) column_of_[as_size(holder)] = kUnassigned;
  return holder;
}

bool Assignment::augment(int row) {
  if (!find_path(row)) return false;
  move_potentials(row);
  flip_path(row);
  return true;
}

/// Dijkstra over reduced costs from `row` to the nearest free column, or to a row for which staying alone is cheaper.
bool Assignment::find_path(int row) {
  start_search();
  for (int from = row;;) {
    const int column = scan(from);
    const double nearest = column == kUnassigned ? kForbidden : distance_[as_size(column)];
    if (shortest_alone_ <= nearest) {
      length_ = shortest_alone_;
      column_end_ = kUnassigned;
      return length_ < kForbidden;
    }
    length_ = nearest;
    scanned_.push_back(column);
    column_end_ = column;
    if (row_of_[as_size(column)] == kUnassigned) return true;
    from = row_of_[as_size(column)];
  }
}

void Assignment::start_search() {
  fit(distance_, columns_, kForbidden);
  fit(reached_from_, columns_, kUnassigned);
  fit(open_, columns_);
  std::iota(open_.begin(), open_.end(), 0);
  fit(scanned_, columns_, 0);
  scanned_.clear();
  fit(tree_rows_, rows_, 0);
  tree_rows_.clear();
  shortest_alone_ = kForbidden;
  length_ = 0.0;
}

/// Adds a row to the tree. Removes the nearest open column from the open ones and returns it; kUnassigned: there is
/// none.
int Assignment::scan(int row) {
  tree_rows_.push_back(row);
  const double base = length_ - of_row_[as_size(row)];
  if (base + alone_[as_size(row)] < shortest_alone_) {
    shortest_alone_ = base + alone_[as_size(row)];
    alone_end_ = row;
  }
  const double* const costs = &costs_[as_size(row) * columns_];
  double nearest = kForbidden;
  std::size_t nearest_at = 0;
  for (std::size_t k = 0; k < open_.size(); ++k) {
    const std::size_t c = as_size(open_[k]);
    const double through = base + costs[c] - of_column_[c];
    if (through < distance_[c]) {
      distance_[c] = through;
      reached_from_[c] = row;
    }
    if (distance_[c] > nearest || (distance_[c] == nearest && row_of_[c] != kUnassigned)) continue;
    nearest = distance_[c];  // of equally near columns prefer a free one, which ends the search
    nearest_at = k;
  }
  if (nearest == kForbidden) return kUnassigned;
  const int column = open_[nearest_at];
  open_[nearest_at] = open_.back();
  open_.pop_back();
  return column;
}

void Assignment::move_potentials(int row) {
  of_row_[as_size(row)] += length_;
  for (const int other : tree_rows_)
    if (other != row) of_row_[as_size(other)] += length_ - distance_[as_size(column_of_[as_size(other)])];
  for (const int column : scanned_) of_column_[as_size(column)] -= length_ - distance_[as_size(column)];
}

void Assignment::flip_path(int row) {
  int column = column_end_;
  if (column == kUnassigned) {
    column = std::exchange(column_of_[as_size(alone_end_)], kUnassigned);
    if (alone_end_ == row) return;
  }
  for (int from = kUnassigned; from != row;) {
    from = reached_from_[as_size(column)];
    row_of_[as_size(column)] = from;
    std::swap(column_of_[as_size(from)], column);
  }
}

}  // namespace azimuth
