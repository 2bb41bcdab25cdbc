#include "slam/smoother/front_tree.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace azimuth {

void FrontTree::mark_stale(Block a, Block b) {
  const int front_a = front_of(a), front_b = front_of(b);
  const auto turn = [this](Block block) { return turn_of_[static_cast<std::size_t>(block)]; };
  const bool b_has_it = front_a == kNone || (front_b != kNone && turn(b) < turn(a));
  const int front = b_has_it ? front_b : front_a;
  if (front != kNone) node(front).stale = true;
}

void FrontTree::mark_all_stale() {
  for (const int front : postorder_) node(front).stale = true;
}

bool FrontTree::couples(Block a, Block b) const {
  const int front_a = front_of(a), front_b = front_of(b);
  if (front_a == kNone || front_b == kNone) return false;
  const auto has = [this](int front, Block block) {
    const std::vector<Block>& blocks = node(front).shape->blocks;
    return std::ranges::find(blocks, block) != blocks.end();
  };
  return has(front_a, b) || has(front_b, a);
}

/// Marks every front that holds the block. These fronts form a connected part of the tree below the front that
/// eliminates the block.
void FrontTree::remove(Block block) {
  const int own = front_of(block);
  if (own == kNone) return;
  changed_.push_back(block);
  for (std::vector<int> waiting = node(own).shape->children; !waiting.empty();) {
    const FrontShape& shape = *node(waiting.back()).shape;
    waiting.pop_back();
    if (std::ranges::find(shape.blocks, block) == shape.blocks.end()) continue;
    changed_.push_back(shape.blocks.front());
    waiting.insert(waiting.end(), shape.children.begin(), shape.children.end());
  }
}

bool FrontTree::update(NormalEquations& equations, double damping) {
  restructured_ = updated_ = 0;
  if (!changed_.empty()) {
    order_changed(equations);
  }
  valid_ = true;
  for (const int at : postorder_) {
    Node& front = node(at);
    if (!front.stale) continue;
    if (front.parent != kNone) node(front.parent).stale = true;
    if (!factorise(front, equations, damping)) valid_ = false;
    ++updated_;
  }
  return valid_;
}

bool FrontTree::factorise(Node& front, NormalEquations& equations, double damping) {
  const FrontShape& shape = *front.shape;
  FrontMatrix& matrix = scratch_.matrix;
  matrix.begin(shape.rows, static_cast<std::size_t>(equations.rows()), damping == 0.0);
  for (std::size_t i = 0; i < shape.eliminated_blocks; ++i) equations.add_terms(shape.blocks[i], matrix);
  if (damping > 0.0) matrix.values().diagonal() *= 1.0 + damping;
  for (const int child : shape.children) hand_over(*node(child).shape, node(child).numbers->rest, matrix);
  matrix.end(shape.rows);

  const bool positive = eliminate_columns(matrix.values(), shape.eliminated);
  // Numbers shared with another tree must not change.
  if (!front.numbers || front.numbers.use_count() > 1)
    front.numbers = std::make_shared<FrontNumbers>();
  else  // synchronises as in SharedPages::edit()
      [[maybe_unused]]
    const std::shared_ptr<FrontNumbers> alone = front.numbers;
  front.numbers->factor = matrix.values().leftCols(shape.eliminated);
  front.numbers->least_pivot = front.numbers->factor.diagonal().minCoeff();
  const auto count = static_cast<std::size_t>(shape.remaining());
  front.numbers->rest.resize(count * (count + 1) / 2);
  double* value = front.numbers->rest.data();
  for (int j = shape.eliminated; j < shape.size(); ++j)
    value = std::copy_n(&matrix.values()(j, j), shape.size() - j, value);
  front.stale = !positive;
  return positive;
}

void FrontTree::forwards(Eigen::VectorXd& b, double negligible) const {
  Eigen::VectorXd local;
  for (const int at : postorder_) {
    const FrontShape& shape = *node(at).shape;
    const FrontNumbers& numbers = *node(at).numbers;
    const std::span own(shape.rows.data(), static_cast<std::size_t>(shape.eliminated));
    const double least = negligible * numbers.least_pivot;
    if (std::ranges::any_of(own, [&](int row) { return !(std::abs(b[row]) <= least); }))
      solve_forwards(shape.rows, numbers, b, local);
    else
      for (const int row : own) b[row] = 0.0;
  }
}

void FrontTree::backwards(Eigen::VectorXd& y, double negligible) const {
  Eigen::VectorXd local;
  for (std::size_t i = postorder_.size(); i-- > 0;) {
    const FrontShape& shape = *node(postorder_[i]).shape;
    const auto rest = shape.rows.begin() + shape.eliminated;
    if (std::any_of(shape.rows.begin(), rest, [&](int row) { return y[row] != 0.0; }) ||
        std::any_of(rest, shape.rows.end(), [&](int row) { return !(std::abs(y[row]) <= negligible); }))
      solve_backwards(shape, *node(postorder_[i]).numbers, y, local);
  }
}

std::size_t FrontTree::factor_entries() const {
  std::size_t entries = 0;
  for (const int at : postorder_)
    entries += static_cast<std::size_t>(node(at).shape->size() * node(at).shape->eliminated);
  return entries;
}

}  // namespace azimuth
