#pragma once
// The linear assignment problem: assigns columns to rows so that the sum of the costs is optimal.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace azimuth {

enum class Objective : std::uint8_t { minimise, maximise };

/// One value per pair (row, column), row-major. An entry of +infinity (when minimising) or -infinity (when maximising)
/// forbids the pair. No entry may be NaN.
struct PairingTable {
  std::span<const double> values;
  std::size_t rows = 0;
  std::size_t columns = 0;
};

inline constexpr int kUnassigned = -1;

/// Exact solver by shortest augmenting paths (Jonker & Volgenant 1987, rectangular as in Crouse 2016), in at most
/// rows^2 * columns steps. Deterministic.
///
/// Thread contract: thread-bound; does not allocate once its workspace has grown to the largest problem.
class Assignment {
 public:
  /// Assigns a distinct column to every row or, where rows outnumber columns, a distinct row to every column.
  /// `column_of_row` gets a column or kUnassigned for each row. Returns false, with the outcome undefined, if forbidden
  /// pairs make that impossible.
  bool solve(const PairingTable& table, Objective objective, std::vector<int>& column_of_row);

  /// Variant in which a row may stay without a column at a value of its own: `alone` has one finite entry per row. This
  /// always has a solution.
  void solve(const PairingTable& table, std::span<const double> alone, Objective objective,
             std::vector<int>& column_of_row);

 private:
  /// The cheapest column of a row by reduced cost, and the second-best cost.
  struct Choice {
    double cost, second;
    int column;  // kUnassigned: no column is cheaper than staying alone
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

  // The loaded problem, in the form of a minimisation. Rows do not outnumber columns unless they may stay alone.
  std::size_t rows_ = 0, columns_ = 0;
  std::vector<double> costs_;
  std::vector<double> alone_;  // cost of leaving each row without a column; infinite: not allowed

  // Dual potentials: cost - of_row_ - of_column_ is never negative, and is zero for assigned pairs.
  std::vector<double> of_row_, of_column_;
  std::vector<int> column_of_, row_of_;  // kUnassigned: none
  std::vector<int> waiting_;             // rows without a column so far

  // State of the running search for a path.
  std::vector<double> distance_;     // length of the path to each column
  std::vector<int> reached_from_;    // row before each column on its path
  std::vector<int> open_, scanned_;  // columns outside and inside the tree of shortest paths
  std::vector<int> tree_rows_;
  double length_ = 0.0;           // length of the present path
  double shortest_alone_ = 0.0;   // length of the shortest path that ends with a row left alone
  int alone_end_ = kUnassigned;   // the row that this path leaves alone
  int column_end_ = kUnassigned;  // free column at the end of the path; kUnassigned: the path ends at alone_end_
};

}  // namespace azimuth
