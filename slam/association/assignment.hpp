#pragma once
// The linear assignment problem: which row takes which column so that the sum of the costs is best.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace azimuth {

enum class Objective : std::uint8_t { minimise, maximise };

/// Row-major values of one pairing each. An entry of +infinity (to be minimised) or -infinity (to be maximised) is
/// gated: the pair is forbidden. No entry is NaN.
struct PairingTable {
  std::span<const double> values;
  std::size_t rows = 0;
  std::size_t columns = 0;
};

inline constexpr int kUnassigned = -1;

/// Solved exactly by shortest augmenting paths (Jonker & Volgenant 1987, rectangular as Crouse 2016), in at most
/// rows^2 * columns steps. Deterministic.
///
/// Thread contract: thread-bound; does not allocate once its workspace has grown to the largest problem.
class Assignment {
 public:
  /// Every row takes a column of its own or, where rows outnumber columns, every column a row. `column_of_row` gets a
  /// column or kUnassigned for each row. False: gated entries make that impossible; then the outcome is left undefined.
  bool solve(const PairingTable& table, Objective objective, std::vector<int>& column_of_row);

  /// A row may also stay without a column, at a value of its own: one finite entry of `alone` for each row. That is
  /// always possible.
  void solve(const PairingTable& table, std::span<const double> alone, Objective objective,
             std::vector<int>& column_of_row);

 private:
  /// The cheapest of a row's columns, by reduced cost, and the next best.
  struct Choice {
    double cost, second;
    int column;  // kUnassigned: none is cheaper than staying alone
  };
  void load(const PairingTable& table, Objective objective, bool transposed);
  bool solve_loaded();
  Choice choose(int row) const;
  int give(int column, int row);
  void take_cheapest();
  bool augment(int row);
  bool find_path(int row);
  void start_search();
  int scan(int row);
  void move_potentials(int row);
  void flip_path(int row);

  // The loaded problem, to be minimised; rows do not outnumber columns unless they may stay alone.
  std::size_t rows_ = 0, columns_ = 0;
  std::vector<double> costs_;
  std::vector<double> alone_;  // of each row; infinite: it may not

  // Dual potentials: cost - of row - of column is never negative, and zero where a row has its column.
  std::vector<double> of_row_, of_column_;
  std::vector<int> column_of_, row_of_;  // kUnassigned: none
  std::vector<int> waiting_;             // rows without their column yet

  // Of the running search for a path.
  std::vector<double> distance_;     // to each column
  std::vector<int> reached_from_;    // row before each column
  std::vector<int> open_, scanned_;  // columns that are not, and that are, on the tree of shortest paths
  std::vector<int> tree_rows_;
  double length_ = 0.0;           // of the path so far
  double shortest_alone_ = 0.0;   // of the paths that end with a row left alone
  int alone_end_ = kUnassigned;   // the row of the shortest of those
  int column_end_ = kUnassigned;  // free column at the path's end; kUnassigned: it ends at alone_end_
};

}  // namespace azimuth
