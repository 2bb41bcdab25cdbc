#include "slam/perception/calibration/ring_search.hpp"

#include <algorithm>
#include <cmath>

#include "slam/geometry/index.hpp"
#include "slam/geometry/same_everywhere.hpp"

namespace azimuth {
namespace {

struct Scored {
  double score = 0.0;
  ImageCircle ring;
};

/// The best rim about one centre among radii from `first` on. The square root of the radius favours the larger of two
/// equally clear rims: the noise of a mean over a ring falls with the root of its length.
Scored best_about(const EdgeMap& map, const ImageCircle& first, double step, std::size_t rings, const RayFan& fan,
                  RingProfile& profile) {
  const double least = std::max(4.0, first.radius);
  const std::size_t inside = rim_reach(least + step * static_cast<double>(rings), step);
  const double start = std::max(1.0, least - step * static_cast<double>(inside));
  const auto skipped = static_cast<std::size_t>(std::lround((least - start) / step));
  read_profile(map, {first.u, first.v, start}, step, skipped + rings + inside, fan, profile);
  Scored best;
  for (std::size_t i = skipped; i < skipped + rings; ++i) {
    const double score = rim_score(profile, i) * std::sqrt(profile.radius(i));
    if (score > best.score) best = {score, {first.u, first.v, profile.radius(i)}};
  }
  return best;
}

std::vector<Scored> best_of_all_centres(const EdgeMap& map) {
  constexpr double kMargin = 0.15, kStep = 2.0;
  const double width = map.detail.cols, height = map.detail.rows, longer = std::max(width, height);
  const RayFan fan(96);
  const auto rings = static_cast<std::size_t>(0.55 * longer);
  std::vector<Scored> all;
  RingProfile profile;
  for (double v = kMargin * height; v < (1.0 - kMargin) * height; v += kStep) {
    for (double u = kMargin * width; u < (1.0 - kMargin) * width; u += kStep) {
      const Scored best = best_about(map, {u, v, 0.1 * longer}, 1.0, rings, fan, profile);
      if (best.score > 0.0) all.push_back(best);
    }
  }
  return all;
}

double apart(const ImageCircle& a, const ImageCircle& b) {
  return hypotenuse(a.u - b.u, a.v - b.v) + std::abs(a.radius - b.radius);
}

/// The best rim within `span` of `start`, in steps of `step`.
ImageCircle best_on_grid(const EdgeMap& map, const ImageCircle& start, double span, double step) {
  const RayFan fan(192);
  const auto rings = static_cast<std::size_t>(std::lround(4.0 * span / step)) + 1;
  RingProfile profile;
  Scored best{0.0, start};
  for (double dv = -span; dv < span + 0.5 * step; dv += step) {
    for (double du = -span; du < span + 0.5 * step; du += step) {
      const ImageCircle first{start.u + du, start.v + dv, start.radius - 2.0 * span};
      const Scored here = best_about(map, first, step, rings, fan, profile);
      if (here.score > best.score) best = here;
    }
  }
  return best.ring;
}

}  // namespace

std::vector<ImageCircle> likely_rims(const EdgeMap& map, std::size_t most) {
  std::vector<Scored> all = best_of_all_centres(map);
  std::stable_sort(all.begin(), all.end(), [](const Scored& a, const Scored& b) { return a.score > b.score; });
  const double least_apart = 0.05 * map.detail.cols;
  std::vector<ImageCircle> rims;
  for (const Scored& each : all) {
    if (rims.size() >= most) break;
    const bool is_new = std::all_of(rims.begin(), rims.end(),
                                    [&](const ImageCircle& rim) { return apart(rim, each.ring) > least_apart; });
    if (is_new) rims.push_back(each.ring);
  }
  return rims;
}

ImageCircle best_rim_near(const EdgeMap& map, const ImageCircle& start, double span) {
  const ImageCircle rough = best_on_grid(map, start, span, span / 3.0);
  return best_on_grid(map, rough, span / 3.0, span / 6.0);
}

ImageCircle inner_disc(const EdgeMap& map, const ImageCircle& rim) {
  constexpr double kLeastFollows = 0.45, kMostOffCentre = 0.08, kLargest = 0.5;
  const RayFan fan(120);
  const double span = kMostOffCentre * rim.radius, step = std::max(1.0, span / 8.0);
  const double smallest = std::max(4.0, 0.05 * rim.radius);
  const auto rings = static_cast<std::size_t>(kLargest * rim.radius - smallest);
  RingProfile profile;
  Scored best{kLeastFollows, {}};
  for (double dv = -span; dv <= span; dv += step) {
    for (double du = -span; du <= span; du += step) {
      read_profile(map, {rim.u + du, rim.v + dv, smallest}, 1.0, rings, fan, profile);
      const auto strongest = std::max_element(profile.follows.begin(), profile.follows.end());
      const auto i = as_size(strongest - profile.follows.begin());
      const ImageCircle ring{rim.u + du, rim.v + dv, profile.radius(i)};
      if (*strongest <= best.score || profile.in_map[i] < 1.0) continue;
      if (detail_between(map, ring, 0.2, 0.7) < detail_between(map, ring, 1.15, 1.6)) best = {*strongest, ring};
    }
  }
  return best.ring;
}

}  // namespace azimuth
