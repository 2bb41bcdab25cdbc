#include "slam/perception/image/row_seams.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr int kCoarseChunks = 16;
constexpr int kNoise = 8;         // Smaller steps are not significant [grey levels]
constexpr int kFewestChunks = 4;  // Fewer chunks do not represent a row
// Ratios are integers, so that their sum does not depend on the order of summation
constexpr float kRatioOne = 4096.0F;
// Greatest net change as a share of all change; a greater one is an edge or flicker.
constexpr float kMostOneWay = 0.7F;
constexpr int kUnit_rows = 16;  // JPEG encodes, and loses, this many rows together
constexpr int kFewestFilled_rows = 8;

constexpr std::size_t kLanes = 4;
using Lanes = float __attribute__((vector_size(4 * kLanes)));
using Counts = std::int32_t __attribute__((vector_size(4 * kLanes)));

template <class Steps>
Lanes load(const Steps& steps, std::size_t first) {
  Lanes lanes;
  std::memcpy(&lanes, &steps[first], sizeof lanes);
  return lanes;
}

}  // namespace

RowSeams::RowSeams(const ImageMask& mask, const FrameFormat& format) {
  const std::vector<std::uint8_t> visible = mask.raster(format.width_px, format.height_px);
  coarse_ = ChunkGrid(visible, format, kCoarseChunks);
  fine_ = ChunkGrid(visible, format, ChunkGrid::kMostChunks);
  last_step_.resize(as_size(coarse_.chunks()));
}

Seam RowSeams::seam(const ImageView& image) {
  look_here_and_there(image);
  const Seam found = look_all_along(image);
  return found.row >= 0 && goes_both_ways(image, found.row) ? found : Seam{};
}

void RowSeams::measure(const ImageView& image, const ChunkGrid& grid, int row) {
  grid.steps(image, row, 0, std::span(kept(row)).first(as_size(grid.chunks())));
}

/// Compares each chunk's step with the larger of the steps before and after it, which gives a ratio from -1 to 1. The
/// sum is divided by the square root of the number of chunks, with which a random sum grows.
double RowSeams::likeness(const ChunkGrid& grid, std::span<const ChunkGrid::Run> runs) {
  const int row = runs.front().row;
  const Steps &before = kept(row - grid.apart()), &here = kept(row), &after = kept(row + grid.apart());
  const float noise = grid.step_of(kNoise);
  Ratios ratios;
  for (std::size_t c = 0; c < as_size(grid.chunks()); c += kLanes) {
    const Lanes step = load(here, c), above = load(before, c), below = load(after, c);
    const Lanes around = above > below ? above : below;
    const Counts ratio = __builtin_convertvector(kRatioOne * (step - around) / (step + around + noise), Counts);
    std::memcpy(&ratios[c], &ratio, sizeof ratio);
  }
  std::int32_t sum = 0;
  int chunks = 0;
  for (const ChunkGrid::Run& run : runs) {
    for (int c = run.first; c < run.end; ++c) sum += ratios[as_size(c)];
    chunks += run.end - run.first;
  }
  return chunks < kFewestChunks ? 0.0 : sum / (kRatioOne * std::sqrt(chunks));
}

void RowSeams::look_here_and_there(const ImageView& image) {
  suspects_.fill({});
  const int apart = coarse_.apart();
  int measured = 0;
  for (auto run = coarse_.runs().begin(), end = coarse_.runs().end(); run != end;) {
    const int row = run->row;
    for (int v = std::max(measured, row - apart); v <= row + apart; ++v) measure(image, coarse_, v);
    measured = row + apart + 1;
    const auto next = std::find_if(run, end, [row](const ChunkGrid::Run& other) { return other.row != row; });
    suspect(row, likeness(coarse_, {run, next}));
    run = next;
  }
}

/// Keeps the most suspicious rows, in descending order.
void RowSeams::suspect(int row, double likeness) {
  if (likeness <= suspects_.back().likeness) return;
  suspects_.back() = {row, likeness};
  for (std::size_t i = suspects_.size() - 1; i > 0 && suspects_[i - 1].likeness < likeness; --i)
    std::swap(suspects_[i - 1], suspects_[i]);
}

Seam RowSeams::look_all_along(const ImageView& image) {
  for (Suspect& suspect : suspects_) {
    if (suspect.row < 0) continue;
    for (int v = suspect.row - fine_.apart(); v <= suspect.row + fine_.apart(); ++v) measure(image, fine_, v);
    suspect.likeness = likeness(fine_, fine_.runs(suspect.row));
  }
  const Suspect& best = *std::ranges::max_element(suspects_, {}, &Suspect::likeness);
  double second = 0.0;  // Rows closer than `apart()` show the same seam
  for (const Suspect& other : suspects_)
    if (&other != &best && std::abs(other.row - best.row) >= fine_.apart()) second = std::max(second, other.likeness);
  return {best.row, best.likeness - second};
}

bool RowSeams::goes_both_ways(const ImageView& image, int row) const {
  int rise = 0;
  float all = 0.0F;
  for (const ChunkGrid::Run& run : fine_.runs(row))
    for (int c = run.first; c < run.end; ++c) {
      float step = 0.0F;
      fine_.steps(image, row, c, std::span(&step, 1));
      rise += fine_.rise(image, row, c);
      all += step;
    }
  return static_cast<float>(std::abs(rise)) < kMostOneWay * all;
}

int RowSeams::filled_from(const ImageView& image) {
  int first = -1;  // The last row with a step in any chunk
  for (int c = 0; c < coarse_.chunks(); ++c) {
    int v = coarse_.lowest(c);
    for (float step = 0.0F; v >= coarse_.apart(); --v) {
      coarse_.steps(image, v, c, std::span(&step, 1));
      if (step > 0.0F) break;
    }
    last_step_[as_size(c)] = v;
    first = std::max(first, v);
  }
  int filled = 0, columns = 0;
  for (int c = 0; c < coarse_.chunks(); ++c) {
    columns += coarse_.lowest(c) >= 0 ? 1 : 0;
    if (coarse_.lowest(c) - first < kFewestFilled_rows) continue;
    if (first - last_step_[as_size(c)] > kUnit_rows) return -1;
    ++filled;
  }
  return 2 * filled >= columns && filled >= kFewestChunks ? first : -1;
}

}  // namespace azimuth
