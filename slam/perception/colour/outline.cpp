#include "slam/perception/colour/outline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "slam/geometry/angle.hpp"

namespace azimuth {
namespace {

using Runs = std::span<const ColourRun>;

/// The leading runs of `runs` that lie in `row`.
Runs first_row(Runs runs, int row) {
  std::size_t count = 0;
  while (count < runs.size() && runs[count].row == row) ++count;
  return runs.first(count);
}

/// Calls `visit` for each column covered by `row` but not by `beside`.
template <class Visit>
void visit_uncovered(Runs row, Runs beside, Visit visit) {
  std::size_t first = 0;
  for (const ColourRun& run : row) {
    int column = run.begin;
    while (first < beside.size() && beside[first].end <= run.begin) ++first;
    for (std::size_t i = first; i < beside.size() && beside[i].begin < run.end; ++i) {
      for (; column < beside[i].begin; ++column) visit(column);
      column = std::max<int>(column, beside[i].end);
    }
    for (; column < run.end; ++column) visit(column);
  }
}

}  // namespace

void outline_of(Runs runs, const SampleGrid& grid, std::vector<CentredPoint>& out) {
  out.clear();
  Runs above, rest = runs;
  while (!rest.empty() || !above.empty()) {
    const int v = above.empty() ? rest.front().row : above.front().row + 1;
    const Runs here = first_row(rest, v);
    const auto add_between_rows = [&](int column) { out.push_back(grid.point(column, v - 0.5)); };
    visit_uncovered(here, above, add_between_rows);
    visit_uncovered(above, here, add_between_rows);
    for (const ColourRun& run : here) {
      out.push_back(grid.point(run.begin - 0.5, v));
      out.push_back(grid.point(run.end - 0.5, v));
    }
    above = here;
    rest = rest.subspan(here.size());
  }
}

double radial_line_rad(std::span<const CentredPoint> points) {
  CentredPoint sum = CentredPoint::Zero();
  double S_xx = 0.0, S_xy = 0.0, S_yy = 0.0;
  for (const CentredPoint& point : points) {
    sum += point;
    S_xx += point.x() * point.x();
    S_xy += point.x() * point.y();
    S_yy += point.y() * point.y();
  }
  const double angle = 0.5 * std::atan2(2.0 * S_xy, S_xx - S_yy);
  const bool towards_centroid = std::cos(angle) * sum.x() + std::sin(angle) * sum.y() >= 0.0;
  return wrap(towards_centroid ? angle : angle + kPi);
}

}  // namespace azimuth
