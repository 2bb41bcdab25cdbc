#include "slam/perception/colour/blobs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;

/// Number of samples of `lower` that have a sample of `upper` above them after `upper` is shifted right by `shift`.
int overlap(const ColourRun& upper, const ColourRun& lower, int shift) {
  return std::max(0, std::min(upper.end + shift, +lower.end) - std::max(upper.begin + shift, +lower.begin));
}

}  // namespace

double compactness(double area, double perimeter) { return 4.0 * std::numbers::pi * area / (perimeter * perimeter); }

/* Crofton's formula over four directions: P = pi / 8 (n_0 + n_90 + (n_45 + n_135) / sqrt 2), where n is the number of
 * times that lines of one direction, one sample apart, cross the outline. The result is exact for a disc and within 5 %
 * for straight outlines of any direction. The number of sample sides would be up to 41 % too long.
 */
double Blobs::perimeter_of(int area, int runs, const Overlap& shared) {
  const int across = 2 * runs, down = 2 * (area - shared.straight);
  const int slanted = 2 * (area - shared.right) + 2 * (area - shared.left);
  return std::numbers::pi / 8.0 * (across + down + slanted / std::numbers::sqrt2);
}

void Blobs::group(std::span<const ColourRun> runs) {
  runs_ = runs;
  parents_.resize(runs.size());
  for (std::uint32_t i = 0; i < parents_.size(); ++i) parents_[i] = i;
  overlaps_.assign(runs.size(), {});
  index_rows();
  for (std::size_t row = 1; row + 1 < row_starts_.size(); ++row) join_rows(row - 1, row);
  collect();
}

void Blobs::index_rows() {
  row_starts_.clear();
  const std::size_t rows = runs_.empty() ? 0 : runs_.back().row + std::size_t{1};
  std::uint32_t run = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    row_starts_.push_back(run);
    while (run < runs_.size() && runs_[run].row == row) ++run;
  }
  row_starts_.push_back(run);
}

void Blobs::join_rows(std::size_t upper, std::size_t lower) {
  std::uint32_t first = row_starts_[upper];
  const std::uint32_t end = row_starts_[upper + 1];
  for (std::uint32_t below = row_starts_[lower]; below < row_starts_[lower + 1]; ++below) {
    const ColourRun& run = runs_[below];
    while (first < end && runs_[first].end < run.begin) ++first;
    for (std::uint32_t above = first; above < end && runs_[above].begin <= run.end; ++above)
      if (runs_[above].class_number == run.class_number) join(above, below);
  }
}

void Blobs::join(std::uint32_t upper, std::uint32_t lower) {
  const ColourRun &above = runs_[upper], &below = runs_[lower];
  Overlap& shared = overlaps_[lower];
  shared.straight += overlap(above, below, 0);
  shared.right += overlap(above, below, 1);
  shared.left += overlap(above, below, -1);
  const auto [early, late] = std::minmax({root(upper), root(lower)});
  parents_[late] = early;
}

std::uint32_t Blobs::root(std::uint32_t run) {
  while (parents_[run] != run) {
    parents_[run] = parents_[parents_[run]];  // Path halving for later searches
    run = parents_[run];
  }
  return run;
}

/// The blob to which a run belongs. A blob's first run, which comes before all its others, creates the blob.
std::uint32_t Blobs::number_of(std::uint32_t run) {
  const std::uint32_t top = root(run);
  if (top == run) {
    numbers_[run] = static_cast<std::uint32_t>(blobs_.size());
    blobs_.push_back({runs_[run].class_number, 0, 0.0, run});
    lasts_.push_back(run);
    sums_.push_back({});
  } else {
    nexts_[lasts_[numbers_[top]]] = run;
    lasts_[numbers_[top]] = run;
  }
  return numbers_[top];
}

void Blobs::collect() {
  blobs_.clear();
  lasts_.clear();
  sums_.clear();
  nexts_.assign(runs_.size(), kNone);
  numbers_.resize(runs_.size());
  for (std::uint32_t run = 0; run < runs_.size(); ++run) {
    const std::uint32_t number = number_of(run);
    blobs_[number].area += runs_[run].length();
    sums_[number].runs += 1;
    sums_[number].shared += overlaps_[run];
  }
  for (std::size_t n = 0; n < blobs_.size(); ++n)
    blobs_[n].perimeter = perimeter_of(blobs_[n].area, sums_[n].runs, sums_[n].shared);
}

void Blobs::runs_of(const Blob& blob, std::vector<ColourRun>& out) const {
  out.clear();
  for (std::uint32_t i = blob.first_run; i != kNone; i = nexts_[i]) out.push_back(runs_[i]);
}

std::uint8_t Blobs::class_at(int column, int row) const {
  if (row < 0 || as_size(row) + 1 >= row_starts_.size()) return 0;
  const auto index = as_size(row);
  const auto first = runs_.begin() + row_starts_[index], last = runs_.begin() + row_starts_[index + 1];
  const auto after = std::upper_bound(first, last, column, [](int at, const ColourRun& run) { return at < run.begin; });
  return after != first && column < (after - 1)->end ? (after - 1)->class_number : std::uint8_t{0};
}

}  // namespace azimuth
