// Joint covariances of some blocks, computed from the factor.

#include <algorithm>

#include "slam/smoother/front_tree.hpp"

namespace azimuth {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The columns E of the identity that belong to the blocks. They are sorted by the order in which the fronts are
/// visited (children first). All columns below a front are then adjacent, so the nonzero columns of L^-1 E in a front
/// form one range.
class FrontTree::Columns {
 public:
  Columns(const FrontTree& tree, std::span<const Block> blocks, const NormalEquations& equations)
      : ranges_(tree.nodes_.size()), place_of_row_(static_cast<std::size_t>(equations.rows()), kNone) {
    std::vector<int> visit_of(tree.nodes_.size(), kNone);
    for (std::size_t visit = 0; visit < tree.postorder_.size(); ++visit)
      visit_of[static_cast<std::size_t>(tree.postorder_[visit])] = static_cast<int>(visit);
    for (const Block block : blocks)
      for (int i = 0; i < equations.size(block); ++i)
        columns_.push_back({visit_of[static_cast<std::size_t>(tree.front_of(block))], equations.first_row(block) + i,
                            static_cast<Eigen::Index>(columns_.size())});
    std::ranges::stable_sort(columns_, {}, &Column::visit);
    find_ranges(tree);
  }

  Eigen::Index count() const { return static_cast<Eigen::Index>(columns_.size()); }
  struct Range {
    Eigen::Index first = 0, end = 0;
    Eigen::Index size() const { return end - first; }
  };
  const Range& in_front(int at) const { return ranges_[static_cast<std::size_t>(at)]; }
  Eigen::Index place_of(int row) const { return place_of_row_[static_cast<std::size_t>(row)]; }

  /// E, restricted to the rows of fronts that have nonzero columns.
  RowMajor identity() const {
    RowMajor E = RowMajor::Zero(rows_, count());
    for (std::size_t i = 0; i < columns_.size(); ++i) E(place_of(columns_[i].row), static_cast<Eigen::Index>(i)) = 1.0;
    return E;
  }
  /// The full symmetric matrix in the order in which the blocks were asked for, from the lower triangle in sorted
  /// order.
  Eigen::MatrixXd as_asked(const Eigen::MatrixXd& sorted) const {
    Eigen::MatrixXd P(count(), count());
    for (std::size_t j = 0; j < columns_.size(); ++j)
      for (std::size_t i = j; i < columns_.size(); ++i) {
        const Eigen::Index a = columns_[i].asked, b = columns_[j].asked;
        P(a, b) = P(b, a) = sorted(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      }
    return P;
  }

 private:
  struct Column {
    int visit = 0;  // visit of the front that eliminates its row
    int row = 0;
    Eigen::Index asked = 0;
  };

  /// Finds each front's range of columns: those of the fronts below, and its own.
  void find_ranges(const FrontTree& tree) {
    std::vector<Eigen::Index> lowest(ranges_.size(), count());
    Eigen::Index column = 0;
    for (std::size_t visit = 0; visit < tree.postorder_.size(); ++visit) {
      const auto at = static_cast<std::size_t>(tree.postorder_[visit]);
      const Eigen::Index first = std::min(lowest[at], column);
      while (column < count() && columns_[static_cast<std::size_t>(column)].visit == static_cast<int>(visit)) ++column;
      ranges_[at] = {first, column};
      if (first == column) continue;
      if (const int parent = tree.nodes_[at].parent; parent != kNone) {
        Eigen::Index& of_parent = lowest[static_cast<std::size_t>(parent)];
        of_parent = std::min(of_parent, first);
      }
      for (const int row : tree.nodes_[at].shape->rows)
        if (int& place = place_of_row_[static_cast<std::size_t>(row)]; place == kNone) place = rows_++;
    }
  }

  std::vector<Column> columns_;
  std::vector<Range> ranges_;  // per node
  std::vector<int> place_of_row_;
  int rows_ = 0;
};

/// The fronts on the paths from the blocks to the root, children before parents.
std::vector<int> FrontTree::way_to_root(std::span<const Block> blocks) const {
  std::vector<char> is_on_it(nodes_.size());
  std::vector<int> way;
  for (const Block block : blocks)
    for (int at = front_of(block); at != kNone && is_on_it[static_cast<std::size_t>(at)] == 0; at = node(at).parent) {
      is_on_it[static_cast<std::size_t>(at)] = 1;
      way.push_back(at);
    }
  std::ranges::sort(way, {}, [this](int at) { return node(at).turn; });
  return way;
}

/// Computes E^T H^-1 E = (L^-1 E)^T (L^-1 E), with H = L L^T and E the columns of the identity that belong to the
/// blocks. L^-1 E is zero except on the paths from these blocks to the root, so only those rows are stored.
Eigen::MatrixXd FrontTree::covariance_of_few(std::span<const Block> blocks, const NormalEquations& equations) const {
  const std::vector<int> way = way_to_root(blocks);
  std::vector<int> place_of(static_cast<std::size_t>(equations.rows()), kNone);
  int places = 0;
  for (const int at : way)
    for (const int row : node(at).shape->rows)
      if (int& place = place_of[static_cast<std::size_t>(row)]; place == kNone) place = places++;
  std::vector<int> rows;
  for (const Block block : blocks)
    for (int i = 0; i < equations.size(block); ++i) rows.push_back(equations.first_row(block) + i);
  const auto columns = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd Y = Eigen::MatrixXd::Zero(places, columns);
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (const int place = place_of[static_cast<std::size_t>(rows[i])]; place != kNone)
      Y(place, static_cast<Eigen::Index>(i)) = 1.0;

  Eigen::MatrixXd P = Eigen::MatrixXd::Zero(columns, columns);
  Eigen::VectorXd local;
  std::vector<int> here;
  for (const int at : way) {
    const FrontShape& shape = *node(at).shape;
    here.clear();
    for (const int row : shape.rows) here.push_back(place_of[static_cast<std::size_t>(row)]);
    solve_forwards(here, *node(at).numbers, Y, local);
    for (std::size_t j = 0; j < static_cast<std::size_t>(shape.eliminated); ++j) {
      const auto y = Y.row(here[j]);
      P += y.transpose() * y;
    }
  }
  return P;
}

/// Computes E^T H^-1 E like covariance_of_few(). For more than a few blocks, most fronts lie on some path to the root,
/// and all are visited.
Eigen::MatrixXd FrontTree::covariance(std::span<const Block> blocks, const NormalEquations& equations) const {
  constexpr std::size_t kFew = 3;
  if (blocks.size() <= kFew) return covariance_of_few(blocks, equations);
  const Columns columns(*this, blocks, equations);
  RowMajor Y = columns.identity(), eliminated, rest;
  Eigen::MatrixXd P = Eigen::MatrixXd::Zero(columns.count(), columns.count());  // lower triangle
  for (const int at : postorder_) {
    const Columns::Range range = columns.in_front(at);
    if (range.size() == 0) continue;
    const FrontShape& shape = *node(at).shape;
    const auto& L = node(at).numbers->factor;
    const auto Y_row = [&](int i) {
      return Y.row(columns.place_of(shape.rows[static_cast<std::size_t>(i)])).segment(range.first, range.size());
    };
    eliminated.resize(shape.eliminated, range.size());
    for (int i = 0; i < shape.eliminated; ++i) eliminated.row(i) = Y_row(i);
    L.topRows(shape.eliminated).triangularView<Eigen::Lower>().solveInPlace(eliminated);
    if (shape.remaining() > 0) {
      rest.noalias() = L.bottomRows(shape.remaining()) * eliminated;
      for (int i = 0; i < shape.remaining(); ++i) Y_row(shape.eliminated + i) -= rest.row(i);
    }
    P.block(range.first, range.first, range.size(), range.size())
        .selfadjointView<Eigen::Lower>()
        .rankUpdate(eliminated.transpose());
  }
  return columns.as_asked(P);
}

}  // namespace azimuth
