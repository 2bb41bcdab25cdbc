#include "slam/perception/image/row_history.hpp"

#include <algorithm>

namespace azimuth {
namespace {

constexpr int kFewestRows = 3;             // Of either part
constexpr double kShareThatSpeaks = 0.75;  // Share of all rows that must have noise; a camera image has more.

/// Whether the rows of two images are equal up to some row and different after it, or the reverse. Rows without noise
/// are not added.
class Parts {
 public:
  void add(bool same) {
    if (rows_ == 0 || same != same_) ++changes_;
    same_ = same;
    ++rows_;
    ++(same ? same_rows_ : other_rows_);
  }
  int rows() const { return rows_; }
  bool two() const { return changes_ == 2 && same_rows_ >= kFewestRows && other_rows_ >= kFewestRows; }

 private:
  bool same_ = false;
  int changes_ = 0, rows_ = 0, same_rows_ = 0, other_rows_ = 0;
};

}  // namespace

RowHistory::RowHistory(std::size_t rows) {
  for (Rows& image : images_) image.resize(rows);
}

bool RowHistory::add() {
  bool torn = false;
  for (std::size_t before = 1; before + 1 <= held_; ++before) torn = torn || has_rows_of(before);
  held_ = std::min(held_ + 1, kImages - 1);
  newest_ = (newest_ + 1) % kImages;
  return torn;
}

bool RowHistory::has_rows_of(std::size_t before) const {
  const Rows &now = image(0), &old = image(before);
  Parts parts;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now[i] != kNothing && is_of_one_instant(before, i)) parts.add(now[i] == old[i]);
  return parts.two() && parts.rows() >= kShareThatSpeaks * static_cast<double>(now.size());
}

bool RowHistory::is_of_one_instant(std::size_t before, std::size_t row) const {
  for (std::size_t other = 1; other <= held_; ++other)
    if (other != before && image(other)[row] == image(before)[row]) return false;
  return true;
}

}  // namespace azimuth
