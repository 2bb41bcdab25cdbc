#include "slam/ekf/batch_update.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

#include "slam/geometry/index.hpp"

namespace azimuth {
namespace {

constexpr Index kFirstRows = 16;

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
  // The padding too: it is computed with, although nobody asks for it.
  W_.assign(as_size(stride_ * (rows + kSpareColumns)), 0.0);
  S_.resize(rows, rows);
  whitened_innovation_.resize(rows);
  parts_.reserve(as_size(rows) * std::tuple_size_v<decltype(ObservationRow::parts)>);
}

bool BatchUpdate::compute(const BlockTriangle& P, std::span<const ObservationRow> rows) {
  const auto count = as_index(rows.size());
  if (S_.rows() < count) reserve(2 * count);
  extent_ = P.extent();
  compute_gain(P, rows);
  return whiten(rows);
}

/// W = P H^T and S = H W + R (lower triangle).
void BatchUpdate::compute_gain(const BlockTriangle& P, std::span<const ObservationRow> rows) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    auto column = W(as_index(k));
    column.setZero();
    for (int p = 0; p < rows[k].count; ++p) add_columns_below(P, rows[k].parts[as_size(p)], column.data());
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

/// out += P(:, part) * coefficients, from the part's first row down.
void BatchUpdate::add_columns_below(const BlockTriangle& P, const ObservationRow::Part& part, double* out) const {
  const Index end = part.offset + part.size;
  const auto& h = part.coefficients;
  for (Index i = part.offset; i < end; ++i)
    for (Index s = 0; s < part.size; ++s) out[i] += h[as_size(s)] * P(i, part.offset + s);
  const double* p = P.column(part.offset);
  const Index n = extent_ - end;
  const auto column = [&](Index s) { return Eigen::Map<const Eigen::VectorXd>(p + s * stride_ + end, n); };
  Eigen::Map<Eigen::VectorXd> below(out + end, n);
  switch (part.size) {  // in one pass, since memory is what takes time
    case 2:
      below += h[0] * column(0) + h[1] * column(1);
      break;
    case 3:
      below += h[0] * column(0) + h[1] * column(1) + h[2] * column(2);
      break;
    case 5:
      below += h[0] * column(0) + h[1] * column(1) + h[2] * column(2) + h[3] * column(3) + h[4] * column(4);
      break;
    default:
      for (Index s = 0; s < part.size; ++s) below += h[as_size(s)] * column(s);
  }
}

/// The rest of P H^T, above the parts. There a part's entries are adjacent rows of each column of the triangle; all
/// parts are served column by column, since columns lie pages apart.
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

/// S = L L^T, W <- W L^-T, innovation <- L^-1 innovation.
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

}  // namespace azimuth
