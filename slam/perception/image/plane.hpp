#pragma once
#include <cassert>
#include <cstddef>
#include <memory>
#include <new>

#include "slam/geometry/index.hpp"

namespace azimuth {

/// Samples stored row by row. Rows are aligned for vector instructions. Each row may be read, and written as scratch,
/// up to kPadding samples beyond its end.
///
/// Storage grows to the largest requested size and is kept. Thread contract: thread-bound.
template <class T>
class Plane {
 public:
  static constexpr int kPadding = 32;

  Plane() = default;
  Plane(int width, int height) { resize(width, height); }

  /// The values of the samples are undefined afterwards.
  void resize(int width, int height) {
    assert(width >= 0 && height >= 0);
    width_ = width;
    height_ = height;
    stride_ = (width + 2 * kPadding - 1) / kPadding * kPadding;
    const std::size_t samples = as_size(stride_) * as_size(height);
    if (samples <= room_) return;
    samples_.reset(static_cast<T*>(::operator new(samples * sizeof(T), kAlignment)));
    room_ = samples;
    for (std::size_t i = 0; i < samples; ++i) samples_[i] = T{};
  }

  int width() const { return width_; }
  int height() const { return height_; }
  int stride() const { return stride_; }  ///< Samples from one row to the next
  T* row(int v) { return samples_.get() + offset(v); }
  const T* row(int v) const { return samples_.get() + offset(v); }
  T& at(int u, int v) { return row(v)[u]; }
  const T& at(int u, int v) const { return row(v)[u]; }

 private:
  static constexpr std::align_val_t kAlignment{64};
  struct Release {
    void operator()(T* samples) const { ::operator delete(samples, kAlignment); }
  };
  std::size_t offset(int v) const { return as_size(v) * as_size(stride_); }

  std::unique_ptr<T[], Release> samples_;
  std::size_t room_ = 0;
  int width_ = 0, height_ = 0, stride_ = 0;
};

}  // namespace azimuth
