#include "slam/perception/image/chunk_grid.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>

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

}  // namespace azimuth
