#include "slam/perception/image/row_seams.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "slam/geometry/index.hpp"

namespace azimuth {

namespace {

bool is_bayer(PixelFormat pixels) { return pixels >= PixelFormat::bayer_rggb8 && pixels <= PixelFormat::bayer_bggr8; }

/// Sums of absolute differences over chunks of `Bytes` bytes. The constant size lets the compiler vectorise the loop.
template <int Bytes>
void differences(const std::uint8_t* a, const std::uint8_t* b, std::ptrdiff_t spacing, std::span<float> sums) {
  for (float& out : sums) {
    int sum = 0;
    for (int i = 0; i < Bytes; ++i) sum += std::abs(a[i] - b[i]);
    out = static_cast<float>(sum);
    a += spacing;
    b += spacing;
  }
}

std::uint64_t bit(int chunk) { return std::uint64_t{1} << chunk; }

}  // namespace

ChunkGrid::ChunkGrid(std::span<const std::uint8_t> visible, const FrameFormat& format, int most_chunks)
    : height_px_(format.height_px),
      apart_(is_bayer(format.pixels) ? 2 : 1),
      chunks_(std::min({most_chunks, kMostChunks, format.width_px / kChunk_px})),
      bytes_per_pixel_(bytes_per_pixel(format.pixels)) {
  if (chunks_ == 0) return;
  const int spacing_px = format.width_px / chunks_;
  spacing_bytes_ = spacing_px * bytes_per_pixel_;
  lowest_.assign(as_size(chunks_), -1);
  std::vector<std::uint64_t> rows(as_size(height_px_));
  for (int v = 0; v < height_px_; ++v)
    for (int c = 0; c < chunks_; ++c) {
      const auto first = visible.begin() + std::ptrdiff_t{v} * format.width_px + std::ptrdiff_t{c} * spacing_px;
      if (std::find(first, first + kChunk_px, 0) != first + kChunk_px) continue;
      rows[as_size(v)] |= bit(c);
      lowest_[as_size(c)] = v;
    }
  find_runs(rows);
}

void ChunkGrid::find_runs(std::span<const std::uint64_t> visible) {
  for (int v = 2 * apart_; v + apart_ < height_px_; ++v) {
    std::uint64_t in_all = ~std::uint64_t{0};
    for (int row = v - 2 * apart_; row <= v + apart_; ++row) in_all &= visible[as_size(row)];
    while (in_all != 0) {
      const int first = std::countr_zero(in_all), end = first + std::countr_one(in_all >> first);
      runs_.push_back({v, first, end});
      in_all &= end < kMostChunks ? ~(bit(end) - 1) : 0;
    }
  }
}

std::span<const ChunkGrid::Run> ChunkGrid::runs(int row) const {
  return {std::ranges::lower_bound(runs_, row, {}, &Run::row), std::ranges::upper_bound(runs_, row, {}, &Run::row)};
}

void ChunkGrid::steps(const ImageView& image, int row, int first, std::span<float> out) const {
  const std::ptrdiff_t offset = std::ptrdiff_t{first} * spacing_bytes_;
  const std::uint8_t *here = image.row(row) + offset, *before = image.row(row - apart_) + offset;
  if (bytes_per_pixel_ == 1) return differences<kChunk_px>(here, before, spacing_bytes_, out);
  if (bytes_per_pixel_ == 2) return differences<2 * kChunk_px>(here, before, spacing_bytes_, out);
  return differences<3 * kChunk_px>(here, before, spacing_bytes_, out);
}

int ChunkGrid::rise(const ImageView& image, int row, int chunk) const {
  const std::ptrdiff_t offset = std::ptrdiff_t{chunk} * spacing_bytes_;
  const std::uint8_t *here = image.row(row) + offset, *before = image.row(row - apart_) + offset;
  int sum = 0;
  for (int i = 0; i < kChunk_px * bytes_per_pixel_; ++i) sum += here[i] - before[i];
  return sum;
}

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
