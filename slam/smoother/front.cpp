#include "slam/smoother/front.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace azimuth {
namespace {

using Eigen::Index;
using Values = Eigen::Map<Eigen::MatrixXd>;

/// Computes column k -= L[:, from..to) L[k, from..to)^T on the rows from k on, four columns at a time. The columns are
/// short, so a matrix product would spend most of its time on preparation.
void reduce_column(Values& values, Index k, Index from, Index to) {
  const Index rows = values.rows() - k;
  const auto below = [&](Index j) { return values.col(j).tail(rows); };
  Index j = from;
  for (; j + 4 <= to; j += 4)
    values.col(k).tail(rows) -= values(k, j) * below(j) + values(k, j + 1) * below(j + 1) +
                                values(k, j + 2) * below(j + 2) + values(k, j + 3) * below(j + 3);
  for (; j < to; ++j) values.col(k).tail(rows) -= values(k, j) * below(j);
}

bool eliminate_small(Values& values, Index eliminated) {
  for (Index j = 0; j < eliminated; ++j) {
    reduce_column(values, j, 0, j);
    const double pivot = values(j, j);
    if (!(pivot > 0.0) || !std::isfinite(pivot)) return false;
    values.col(j).tail(values.rows() - j) *= 1.0 / std::sqrt(pivot);
  }
  for (Index k = eliminated; k < values.cols(); ++k) reduce_column(values, k, 0, eliminated);
  return true;
}

/// Gives the result of eliminate_small(), computed in blocks that stay in the cache:
/// A = [L11; L21] [L11; L21]^T + [0; S].
bool eliminate_large(Values& values, Index eliminated) {
  Eigen::Ref<Eigen::MatrixXd> top = values.topLeftCorner(eliminated, eliminated);
  if (const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(top); factor.info() != Eigen::Success) return false;
  const Index rest = values.rows() - eliminated;
  if (rest == 0) return true;
  auto left = values.bottomLeftCorner(rest, eliminated);
  top.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(left);
  values.bottomRightCorner(rest, rest).selfadjointView<Eigen::Lower>().rankUpdate(left, -1.0);
  return true;
}

// Sizes below which preparing a matrix product takes longer than the product.
constexpr Index kLarge_columns = 16, kLarge_rows = 48;

}  // namespace

bool eliminate_columns(Values& values, int eliminated) {
  const bool large = eliminated >= kLarge_columns && values.rows() >= kLarge_rows;
  return large ? eliminate_large(values, eliminated) : eliminate_small(values, eliminated);
}

void hand_over(const FrontShape& child, const std::vector<double>& rest, FrontMatrix& parent) {
  const std::vector<int>& rows = parent.rows_of(child.rows.data() + child.eliminated, child.remaining());
  Values& values = parent.values();
  const double* value = rest.data();
  for (auto column = rows.begin(); column != rows.end(); ++column)
    for (auto row = column; row != rows.end(); ++row)
      values(std::max(*row, *column), std::min(*row, *column)) += *value++;
}

// The front's rows are scattered over the whole vector. They are gathered, solved, and written back.

void solve_forwards(const std::vector<int>& rows, const FrontNumbers& numbers, Eigen::Ref<Eigen::MatrixXd> whole,
                    Eigen::VectorXd& local) {
  const auto& L = numbers.factor;
  const Index size = L.rows();
  local.resize(std::max(local.size(), size));
  for (Index column = 0; column < whole.cols(); ++column) {
    double* const y = whole.col(column).data();
    for (Index i = 0; i < size; ++i) local[i] = y[rows[static_cast<std::size_t>(i)]];
    for (Index j = 0; j < L.cols(); ++j) {
      local[j] /= L(j, j);
      local.segment(j + 1, size - j - 1) -= local[j] * L.col(j).tail(size - j - 1);
    }
    for (Index i = 0; i < size; ++i) y[rows[static_cast<std::size_t>(i)]] = local[i];
  }
}

void solve_backwards(const FrontShape& shape, const FrontNumbers& numbers, Eigen::Ref<Eigen::VectorXd> whole,
                     Eigen::VectorXd& local) {
  const auto& L = numbers.factor;
  const Index rows = L.rows();
  local.resize(std::max(local.size(), rows));
  for (Index i = 0; i < rows; ++i) local[i] = whole[shape.rows[static_cast<std::size_t>(i)]];
  for (Index j = L.cols() - 1; j >= 0; --j) {
    local[j] = (local[j] - L.col(j).tail(rows - j - 1).dot(local.segment(j + 1, rows - j - 1))) / L(j, j);
    whole[shape.rows[static_cast<std::size_t>(j)]] = local[j];
  }
}

void FrontMatrix::begin(const std::vector<int>& rows, std::size_t whole_rows, bool kept) {
  const auto size = static_cast<Index>(rows.size());
  storage_.assign(rows.size() * rows.size(), 0.0);
  new (&values_) Values(storage_.data(), size, size);
  places_.resize(std::max(places_.size(), whole_rows), kNotHere);
  for (std::size_t i = 0; i < rows.size(); ++i) places_[static_cast<std::size_t>(rows[i])] = static_cast<int>(i);
  kept_ = kept;
}

void FrontMatrix::end(const std::vector<int>& rows) {
  for (const int row : rows) places_[static_cast<std::size_t>(row)] = kNotHere;
}

}  // namespace azimuth
