#include "slam/ekf/batch_update.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

#include "slam/ekf/column_sum.hpp"
#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr Index kFirstRows = 16;
constexpr Index kMostParts = std::tuple_size_v<decltype(ObservationRow::parts)>;
constexpr Index kMostColumns = kMostParts * std::tuple_size_v<decltype(ObservationRow::Part::coefficients)>;

}  // namespace

void ObservationRow::add(Index offset, std::span<const double> coefficients) {
  assert(count < static_cast<int>(parts.size()) && coefficients.size() <= std::size(Part{}.coefficients));
  Part& part = parts[as_size(count++)];
  part.offset = offset;
  part.size = as_index(coefficients.size());
  std::copy(coefficients.begin(), coefficients.end(), part.coefficients.begin());
}

void BatchUpdate::fit(const BlockTriangle& P) {
  if (stride_ == P.stride()) return;
  stride_ = P.stride();
  reserve(std::max(S_.rows(), kFirstRows));
}

void BatchUpdate::reserve(Index rows) {
  // The padding must be zeroed too: it enters the computation, although its results are not used.
  W_.assign(as_size(stride_ * (rows + kSpareColumns)), 0.0);
  S_.resize(rows, rows);
  whitened_innovation_.resize(rows);
  factors_.resize(rows);
  scaled_.reserve(as_size(std::max(rows, kMostColumns)));
  parts_.reserve(as_size(rows * kMostParts));
}

bool BatchUpdate::compute(const BlockTriangle& P, std::span<const ObservationRow> rows) {
  const auto count = as_index(rows.size());
  if (S_.rows() < count) reserve(2 * count);
  extent_ = P.extent();
  compute_gain(P, rows);
  return whiten(rows);
}

/// Computes W = P H^T and S = H W + R (lower triangle).
void BatchUpdate::compute_gain(const BlockTriangle& P, std::span<const ObservationRow> rows) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    auto column = W(as_index(k));
    column.setZero();
    add_columns_below(P, rows[k], column.data());
  }
  add_rows_left(P, rows);
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t c = 0; c <= r; ++c) {
      double sum = r == c ? rows[r].variance : 0.0;
      for (int p = 0; p < rows[r].count; ++p) {
        const auto& part = rows[r].parts[as_size(p)];
        for (Index i = 0; i < part.size; ++i) sum += part.coefficients[as_size(i)] * W(as_index(c))(part.offset + i);
      }
      S_(as_index(r), as_index(c)) = sum;
    }
}

/// out += P(:, part) * coefficients for each part, from the part's first row down. All parts above a row are added in
/// one pass. Parts may overlap.
void BatchUpdate::add_columns_below(const BlockTriangle& P, const ObservationRow& row, double* out) {
  const std::span<const ObservationRow::Part> parts(row.parts.data(), as_size(row.count));
  for (Index first = 0, last = 0; first < extent_; first = last) {
    last = extent_;  // end of the rows that have the same parts above them
    for (const auto& part : parts)
      if (first < part.end()) last = std::min(last, first < part.offset ? part.offset : part.end());
    scaled_.clear();
    for (const auto& part : parts)
      if (part.end() <= first) {
        scale_columns(P, part, first);
      } else if (part.offset <= first) {  // rows of the part itself, at the edge of the triangle
        add_columns(scaled_, last - first, out + first);
        scaled_.clear();
        for (Index i = first; i < last; ++i)
          for (Index s = 0; s < part.size; ++s) out[i] += part.coefficients[as_size(s)] * P(i, part.offset + s);
      }
    add_columns(scaled_, last - first, out + first);
  }
}

/// Appends the part's columns to the present sum, which starts at `row`.
void BatchUpdate::scale_columns(const BlockTriangle& P, const ObservationRow::Part& part, Index row) {
  // The four columns of a ray are added one by one: another order rounds differently, and recorded logs would not
  // replay to the same bits.
  const Index together = part.size == 4 ? 1 : part.size;
  for (Index s = 0; s < part.size; s += together)
    scaled_.push_back({P.column(part.offset + s) + row, stride_, &part.coefficients[as_size(s)], together});
}

/// Adds the rest of P H^T: the rows above the parts. In these rows the entries of a part are adjacent rows of each
/// column of the triangle. All parts are processed column by column, since columns are pages apart in memory.
void BatchUpdate::add_rows_left(const BlockTriangle& P, std::span<const ObservationRow> rows) {
  sort_parts(rows);
  auto first = parts_.begin();
  for (Index i = 0; i < extent_; ++i) {
    while (first != parts_.end() && first->part.offset <= i) ++first;
    if (first == parts_.end()) return;
    const double* column = P.column(i);
    for (auto placed = first; placed != parts_.end(); ++placed) {
      const auto& [offset, size, h] = placed->part;
      double sum = h[0] * column[offset];
      for (Index s = 1; s < size; ++s) sum += h[as_size(s)] * column[offset + s];
      W_[as_size(placed->row * stride_ + i)] += sum;
    }
  }
}

void BatchUpdate::sort_parts(std::span<const ObservationRow> rows) {
  parts_.clear();
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (int p = 0; p < rows[k].count; ++p) parts_.push_back({rows[k].parts[as_size(p)], as_index(k)});
  std::sort(parts_.begin(), parts_.end(), [](const PlacedPart& a, const PlacedPart& b) {
    return a.part.offset != b.part.offset ? a.part.offset < b.part.offset : a.row < b.row;
  });
}

/// Factorises S = L L^T and whitens: W <- W L^-T, innovation <- L^-1 innovation.
bool BatchUpdate::whiten(std::span<const ObservationRow> rows) {
  const Index count = as_index(rows.size());
  for (Index r = 0; r < count; ++r) {
    for (Index c = 0; c <= r; ++c) {
      double sum = S_(r, c);
      for (Index k = 0; k < c; ++k) sum -= S_(r, k) * S_(c, k);
      if (c < r)
        S_(r, c) = sum / S_(c, c);
      else if (sum > 0.0)
        S_(r, r) = std::sqrt(sum);
      else
        return false;
    }
    double sum = rows[as_size(r)].innovation;
    for (Index k = 0; k < r; ++k) sum -= S_(r, k) * whitened_innovation_(k);
    whitened_innovation_(r) = sum / S_(r, r);
  }
  whiten_columns(W_.data(), stride_, extent_, S_.data(), S_.outerStride(), count);
  return true;
}

template <class Factor>
void BatchUpdate::add_products(Index columns, Factor factor, double* out) {
  scaled_.clear();
  for (Index k = 0; k < columns; ++k) {
    factors_(k) = factor(k);
    scaled_.push_back({W(k).data(), stride_, &factors_(k), 1});
  }
  add_columns(scaled_, extent_, out);
}

void BatchUpdate::add_correction(Index rows, double* x) {
  add_products(
      rows, [&](Index k) { return whitened_innovation_(k); }, x);
}

void BatchUpdate::subtract_products_with(Index entry, Index columns, double* column) {
  add_products(
      columns, [&](Index k) { return -W(k)(entry); }, column);
}

}  // namespace azimuth
