#include "slam/smoother/front_tree.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "slam/smoother/elimination.hpp"

namespace azimuth {
namespace {

// Partial reordering is good for the newest blocks only. The whole tree is ordered anew when it has grown by this share
// and by this number of blocks.
constexpr double kGrowthBeforeNewOrder = 0.12;
constexpr std::size_t kBlocksBeforeNewOrder = 32;

}  // namespace

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

// The shape of the tree: its fronts, and the blocks that each front eliminates.

/// The part of the tree that is ordered anew: blocks, and the fronts below it that have lost their parent.
class FrontTree::Part {
 public:
  std::vector<Block> blocks;  // ascending
  std::vector<int> orphans;

  static constexpr int kElsewhere = -1;
  /// Index of a block in `blocks`; kElsewhere when it is not among them.
  int number_of(Block block) const {
    const auto found = std::ranges::lower_bound(blocks, block);
    return found != blocks.end() && *found == block ? static_cast<int>(found - blocks.begin()) : kElsewhere;
  }
  Block block(int number) const { return blocks[static_cast<std::size_t>(number)]; }
  /// Indices of the blocks that a front leaves to its parent.
  std::vector<int> left_by(const FrontShape& shape) const {
    std::vector<int> numbers;
    for (std::size_t i = shape.eliminated_blocks; i < shape.blocks.size(); ++i)
      numbers.push_back(number_of(shape.blocks[i]));
    return numbers;
  }
};

void FrontTree::order_changed(const NormalEquations& equations) {
  const Part part = take_out_changed(equations);
  const Elimination elimination = eliminate(part, equations);
  std::vector<int> sizes;
  for (const Block block : part.blocks) sizes.push_back(equations.size(block));
  put_back(part, group_into_fronts(elimination, sizes), equations);
  for (const int number : elimination.order) turn_of_[static_cast<std::size_t>(part.block(number))] = turns_++;
  restructured_ = part.blocks.size();
  list_postorder();
  changed_.clear();
}

bool FrontTree::wants_new_order() const {
  const auto grown = static_cast<std::size_t>(kGrowthBeforeNewOrder * static_cast<double>(ordered_));
  return blocks_ + changed_.size() > ordered_ + std::max(kBlocksBeforeNewOrder, grown);
}

/// Takes out the fronts of the changed blocks and all fronts above them.
FrontTree::Part FrontTree::take_out_changed(const NormalEquations& equations) {
  const bool everything = wants_new_order();
  std::vector<char> gone(nodes_.size(), everything ? 1 : 0);
  const auto is_gone = [&gone](int at) { return gone[static_cast<std::size_t>(at)] != 0; };
  for (const Block block : changed_)
    for (int at = front_of(block); at != kNone && !is_gone(at); at = node(at).parent)
      gone[static_cast<std::size_t>(at)] = 1;

  Part part;
  for (const int at : postorder_)
    if (!is_gone(at) && node(at).parent != kNone && is_gone(node(at).parent)) part.orphans.push_back(at);
  part.blocks = changed_;
  for (const int at : postorder_)
    if (is_gone(at)) take_out(at, part.blocks);
  std::erase_if(part.blocks, [&](Block block) { return equations.size(block) == 0; });
  std::ranges::sort(part.blocks);
  part.blocks.erase(std::unique(part.blocks.begin(), part.blocks.end()), part.blocks.end());
  blocks_ += part.blocks.size();
  if (everything) ordered_ = blocks_;
  return part;
}

void FrontTree::take_out(int at, std::vector<Block>& blocks) {
  const FrontShape& shape = *node(at).shape;
  for (std::size_t i = 0; i < shape.eliminated_blocks; ++i) {
    front_of_[static_cast<std::size_t>(shape.blocks[i])] = kNone;
    blocks.push_back(shape.blocks[i]);
  }
  blocks_ -= shape.eliminated_blocks;
  node(at) = Node{};
  free_.push_back(at);
}

/// Orders the part's blocks. Blocks are tied by terms and by the Schur complements of the orphans.
Elimination FrontTree::eliminate(const Part& part, const NormalEquations& equations) const {
  EliminationGraph graph(part.blocks.size());
  std::vector<std::uint8_t> ranks;
  std::vector<Block> neighbours;
  for (const Block block : part.blocks) {
    const auto number = static_cast<int>(ranks.size());
    ranks.push_back(equations.rank(block));
    neighbours.clear();
    equations.append_neighbours(block, neighbours);
    for (const Block other : neighbours)
      if (const int other_number = part.number_of(other); other_number != Part::kElsewhere)
        graph.tie(number, other_number);
  }
  for (const int orphan : part.orphans) graph.tie_all(part.left_by(*node(orphan).shape));
  return graph.eliminate(ranks);
}

void FrontTree::put_back(const Part& part, const std::vector<FrontDraft>& drafts, const NormalEquations& equations) {
  if (const auto blocks = part.blocks.empty() ? 0 : static_cast<std::size_t>(part.blocks.back()) + 1;
      front_of_.size() < blocks) {
    front_of_.resize(blocks, kNone);
    turn_of_.resize(blocks);
  }
  std::vector<int> places;  // node of each draft
  std::vector<std::vector<int>> children(drafts.size());
  std::vector<int> draft_of(part.blocks.size());
  for (const FrontDraft& draft : drafts) {
    const auto own = static_cast<int>(places.size());
    places.push_back(free_node());
    for (const int number : draft.eliminated) {
      front_of_[static_cast<std::size_t>(part.block(number))] = places.back();
      draft_of[static_cast<std::size_t>(number)] = own;
    }
    if (draft.parent == FrontDraft::kRoot) continue;
    node(places.back()).parent = places[static_cast<std::size_t>(draft.parent)];
    children[static_cast<std::size_t>(draft.parent)].push_back(places.back());
  }
  // The blocks that an orphan leaves are tied to each other, so one front holds all of them: the front of the block
  // that is eliminated first, which is the lowest.
  for (const int orphan : part.orphans) {
    int draft = FrontDraft::kRoot;
    for (const int number : part.left_by(*node(orphan).shape))
      draft = std::max(draft, draft_of[static_cast<std::size_t>(number)]);
    node(orphan).parent = places[static_cast<std::size_t>(draft)];
    children[static_cast<std::size_t>(draft)].push_back(orphan);
  }
  for (std::size_t i = 0; i < drafts.size(); ++i)
    node(places[i]).shape = shape_of(part, drafts[i], std::move(children[i]), equations);
}

std::shared_ptr<const FrontShape> FrontTree::shape_of(const Part& part, const FrontDraft& draft,
                                                      std::vector<int> children,
                                                      const NormalEquations& equations) const {
  auto shape = std::make_shared<FrontShape>();
  const auto append = [&](const std::vector<int>& numbers) {
    for (const int number : numbers) {
      const Block block = part.block(number);
      shape->blocks.push_back(block);
      for (int row = 0; row < equations.size(block); ++row) shape->rows.push_back(equations.first_row(block) + row);
    }
  };
  append(draft.eliminated);
  shape->eliminated_blocks = shape->blocks.size();
  shape->eliminated = static_cast<int>(shape->rows.size());
  append(draft.behind);
  shape->children = std::move(children);
  return shape;
}

int FrontTree::free_node() {
  if (free_.empty()) {
    nodes_.emplace_back();
    return static_cast<int>(nodes_.size()) - 1;
  }
  const int at = free_.back();
  free_.pop_back();
  return at;
}

/// Lists the fronts, children before parents.
void FrontTree::list_postorder() {
  std::vector<int> waiting;
  for (std::size_t at = 0; at < nodes_.size(); ++at)
    if (nodes_[at].shape && nodes_[at].parent == kNone) waiting.push_back(static_cast<int>(at));
  postorder_.clear();
  while (!waiting.empty()) {
    const int at = waiting.back();
    waiting.pop_back();
    postorder_.push_back(at);
    waiting.insert(waiting.end(), node(at).shape->children.begin(), node(at).shape->children.end());
  }
  std::ranges::reverse(postorder_);
  for (std::size_t i = 0; i < postorder_.size(); ++i) node(postorder_[i]).turn = static_cast<int>(i);
}

}  // namespace azimuth
