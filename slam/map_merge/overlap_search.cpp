#include "slam/map_merge/overlap_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <utility>

#include "slam/geometry/random.hpp"
#include "slam/geometry/rigid_alignment.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kMostPairs = 600;      // Pairs of landmarks of b that are compared with those of a
constexpr std::size_t kMostTried = 400'000;  // Number of transforms
constexpr std::size_t kMostKept = 24;
constexpr std::size_t kMostRefined = 400;
constexpr double kSigmas = 3.5;
constexpr double kLeastTolerance_m = 0.15, kShareOfSpacing = 0.45;

double median(std::vector<double> values) {
  const auto middle = values.begin() + as_index(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double spacing_m(const MapGaussian& map) {
  std::vector<double> nearest;
  for (std::size_t i = 0; i < map.size(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < map.size(); ++k)
      if (k != i) least = std::min(least, (map.point(i) - map.point(k)).norm());
    nearest.push_back(least);
  }
  return median(std::move(nearest));
}

double typical_variance_m2(const MapGaussian& map) {
  std::vector<double> variances;
  for (std::size_t i = 0; i < map.size(); ++i) variances.push_back(0.5 * map.covariance_of(i).trace());
  return median(std::move(variances));
}

/// Variance of the distance between two landmarks of one map; the common error of the map's frame cancels.
double distance_variance_m2(const MapGaussian& map, std::size_t i, std::size_t k, const Eigen::Vector2d& along) {
  const Eigen::Matrix2d both = map.covariance.block<2, 2>(map.row[i], map.row[k]);
  const Eigen::Matrix2d relative = map.covariance_of(i) + map.covariance_of(k) - both - both.transpose();
  return std::max(0.0, along.dot(relative * along));
}

struct Stretch {
  double length_m, variance_m2;
  std::size_t from, to;
};

Stretch stretch_of(const MapGaussian& map, std::size_t i, std::size_t k) {
  const Eigen::Vector2d between = map.point(k) - map.point(i);
  const double length_m = between.norm();
  if (!(length_m > 0.0)) return {0.0, 0.0, i, k};
  return {length_m, distance_variance_m2(map, i, k, between / length_m), i, k};
}

/// Spatial index of a map's landmarks.
class Cells {
 public:
  Cells(const MapGaussian& map, double side_m) : map_(map), side_m_(side_m) {
    for (std::size_t i = 0; i < map.size(); ++i) cells_[key(cell(map.point(i)))].push_back(i);
  }
  template <class Use>
  void each_near(const Eigen::Vector2d& point, Use use) const {
    const auto middle = cell(point);
    for (std::int64_t dx = -1; dx <= 1; ++dx)
      for (std::int64_t dy = -1; dy <= 1; ++dy)
        if (const auto found = cells_.find(key({middle.first + dx, middle.second + dy})); found != cells_.end())
          for (const std::size_t i : found->second)
            if ((map_.point(i) - point).norm() <= side_m_) use(i);
  }

 private:
  using Cell = std::pair<std::int64_t, std::int64_t>;
  Cell cell(const Eigen::Vector2d& point) const {
    return {static_cast<std::int64_t>(std::floor(point.x() / side_m_)),
            static_cast<std::int64_t>(std::floor(point.y() / side_m_))};
  }
  static std::int64_t key(const Cell& at) { return at.first * 4'000'037 + at.second; }

  const MapGaussian& map_;
  double side_m_;
  std::unordered_map<std::int64_t, std::vector<std::size_t>> cells_;
};

class Search {
 public:
  Search(const MapGaussian& a, const MapGaussian& b, double tolerance_m)
      : a_(a), b_(b), tolerance_m_(tolerance_m), cells_(a, tolerance_m) {
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t k = i + 1; k < a.size(); ++k) stretches_.push_back(stretch_of(a, i, k));
    std::sort(stretches_.begin(), stretches_.end(),
              [](const Stretch& p, const Stretch& q) { return p.length_m < q.length_m; });
    for (const Stretch& stretch : stretches_) widest_m2_ = std::max(widest_m2_, stretch.variance_m2);
  }

  std::vector<SuggestedTransform> run() && {
    const std::size_t size = b_.size(), all = size * (size - 1) / 2;
    if (all <= kMostPairs) {
      for (std::size_t i = 0; i < size; ++i)
        for (std::size_t k = i + 1; k < size; ++k) try_stretch(stretch_of(b_, i, k));
    } else {
      SplitMix bits(1);
      for (std::size_t n = 0; n < kMostPairs; ++n) {
        const std::size_t i = bits.index(size), k = bits.index(size);
        if (i != k) try_stretch(stretch_of(b_, i, k));
      }
    }
    return distinct();
  }

 private:
  /// Short distances are skipped, since they hardly constrain the heading.
  void try_stretch(const Stretch& of_b) {
    if (of_b.length_m < 3.0 * tolerance_m_) return;
    const double most_m = kSigmas * std::sqrt(of_b.variance_m2 + widest_m2_) + 0.02;
    auto stretch = std::lower_bound(stretches_.begin(), stretches_.end(), of_b.length_m - most_m,
                                    [](const Stretch& s, double length_m) { return s.length_m < length_m; });
    for (; stretch != stretches_.end() && stretch->length_m <= of_b.length_m + most_m; ++stretch) {
      const double sigma_m = std::sqrt(of_b.variance_m2 + stretch->variance_m2);
      if (std::abs(stretch->length_m - of_b.length_m) > kSigmas * sigma_m + 0.02) continue;
      try_both({stretch->from, of_b.from}, {stretch->to, of_b.to});
      try_both({stretch->to, of_b.from}, {stretch->from, of_b.to});
    }
  }
  void try_both(const Correspondence& from, const Correspondence& to) {
    if (tried_ >= kMostTried || !may_be_one(a_, b_, from) || !may_be_one(a_, b_, to)) return;
    ++tried_;
    const std::array<Eigen::Vector2d, 2> in_a{a_.point(from.a), a_.point(to.a)}, in_b{b_.point(from.b), b_.point(to.b)};
    const SuggestedTransform suggested{align(in_b, in_a), 0};
    keep({suggested.T_a_b, agreeing(suggested.T_a_b)});
  }
  std::size_t agreeing(const Pose2& T_a_b) const {
    std::size_t count = 0;
    for (std::size_t k = 0; k < b_.size(); ++k) {
      bool lands = false;
      cells_.each_near(T_a_b * b_.point(k), [&](std::size_t i) { lands = lands || may_be_one(a_, b_, {i, k}); });
      if (lands) ++count;
    }
    return count;
  }
  static bool is_better(const SuggestedTransform& one, const SuggestedTransform& other) {
    return one.agreeing > other.agreeing;
  }
  void keep(const SuggestedTransform& suggested) {
    if (suggested.agreeing < 3) return;
    kept_.push_back(suggested);
    if (kept_.size() < 2 * kMostRefined) return;
    std::stable_sort(kept_.begin(), kept_.end(), is_better);
    kept_.resize(kMostRefined);
  }
  SuggestedTransform refined(const Pose2& T_a_b) const {
    const std::vector<Correspondence> pairs = mutual_pairs(a_, b_, T_a_b, tolerance_m_);
    std::vector<Eigen::Vector2d> in_a, in_b;
    for (const Correspondence& pair : pairs) {
      in_a.push_back(a_.point(pair.a));
      in_b.push_back(b_.point(pair.b));
    }
    if (pairs.size() < 3) return {T_a_b, pairs.size()};
    const Pose2 better = align(in_b, in_a);
    return {better, mutual_pairs(a_, b_, better, tolerance_m_).size()};
  }
  std::vector<SuggestedTransform> distinct() {
    std::stable_sort(kept_.begin(), kept_.end(), is_better);
    if (kept_.size() > kMostRefined) kept_.resize(kMostRefined);
    for (SuggestedTransform& each : kept_) each = refined(refined(each.T_a_b).T_a_b);
    std::stable_sort(kept_.begin(), kept_.end(), is_better);
    std::vector<SuggestedTransform> chosen;
    for (const SuggestedTransform& each : kept_) {
      const bool is_new = std::none_of(chosen.begin(), chosen.end(), [&](const SuggestedTransform& other) {
        return farthest_m(b_, each.T_a_b, other.T_a_b) < tolerance_m_;
      });
      if (is_new && each.agreeing >= 3) chosen.push_back(each);
      if (chosen.size() == kMostKept) break;
    }
    return chosen;
  }

  const MapGaussian &a_, &b_;
  double tolerance_m_;
  Cells cells_;
  std::vector<Stretch> stretches_;
  double widest_m2_ = 0.0;
  std::size_t tried_ = 0;
  std::vector<SuggestedTransform> kept_;
};

/// For each landmark of b: the nearest landmark of a that may be the same; a.size() if there is none.
std::vector<std::size_t> nearest_in_a(const MapGaussian& a, const MapGaussian& b, const Pose2& T_a_b,
                                      double tolerance_m, const Cells& cells) {
  std::vector<std::size_t> nearest(b.size(), a.size());
  for (std::size_t k = 0; k < b.size(); ++k) {
    const Eigen::Vector2d p_a = T_a_b * b.point(k);
    double least_m = tolerance_m;
    cells.each_near(p_a, [&](std::size_t i) {
      const double off_m = (a.point(i) - p_a).norm();
      if (off_m > least_m || !may_be_one(a, b, {i, k})) return;
      least_m = off_m;
      nearest[k] = i;
    });
  }
  return nearest;
}

}  // namespace

double landing_tolerance_m(const MapGaussian& a, const MapGaussian& b) {
  const double sigma_m = std::sqrt(typical_variance_m2(a) + typical_variance_m2(b));
  const double most_m = kShareOfSpacing * std::min(spacing_m(a), spacing_m(b));
  return std::max(kLeastTolerance_m, std::min(kSigmas * sigma_m, most_m));
}

std::vector<Correspondence> mutual_pairs(const MapGaussian& a, const MapGaussian& b, const Pose2& T_a_b,
                                         double tolerance_m) {
  const std::vector<std::size_t> of_b = nearest_in_a(a, b, T_a_b, tolerance_m, Cells(a, tolerance_m));
  const std::vector<std::size_t> of_a = nearest_in_a(b, a, inverse(T_a_b), tolerance_m, Cells(b, tolerance_m));
  std::vector<Correspondence> pairs;
  for (std::size_t k = 0; k < b.size(); ++k)
    if (of_b[k] < a.size() && of_a[of_b[k]] == k) pairs.push_back({of_b[k], k});
  return pairs;
}

double farthest_m(const MapGaussian& b, const Pose2& one, const Pose2& other) {
  double most_m = 0.0;
  for (std::size_t k = 0; k < b.size(); ++k) most_m = std::max(most_m, (one * b.point(k) - other * b.point(k)).norm());
  return most_m;
}

std::vector<SuggestedTransform> suggest_transforms(const MapGaussian& a, const MapGaussian& b, double tolerance_m) {
  if (a.size() < 3 || b.size() < 3) return {};
  return Search(a, b, tolerance_m).run();
}

}  // namespace azimuth
