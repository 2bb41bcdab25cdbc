#include "slam/perception/calibration/mirror_finder.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "slam/geometry/index.hpp"
#include "slam/geometry/same_everywhere.hpp"
#include "slam/perception/calibration/edge_circles.hpp"
#include "slam/perception/image/gray.hpp"

namespace azimuth {
namespace {

constexpr double kCoarseSide = 192.0, kFineSide = 640.0;
constexpr std::size_t kCandidates = 16;

// Least values for a mirror. Circles that arise by chance from clutter fail at least one of them.
constexpr double kLeastClearness = 0.35, kLeastSeen = 0.6, kLeastContrast = 0.1;

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

/// Returns rings that may be the rim of a mirror, the best first, at most `most` and well apart. The search covers all
/// centres in the inner part of the map and all radii from a tenth of the map's longer side.
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

/// Returns the ring with the best rim_score() near `start`. The centre is searched within `span` and the radius within
/// twice `span`, first coarsely, then finely.
ImageCircle best_rim_near(const EdgeMap& map, const ImageCircle& start, double span) {
  const ImageCircle rough = best_on_grid(map, start, span, span / 3.0);
  return best_on_grid(map, rough, span / 3.0, span / 6.0);
}

/// Finds the disc in the middle of a mirror in which camera and robot see themselves: the strongest closed edge within
/// half of the rim's radius and nearly concentric with the rim, with less detail inside than outside. Radius 0 if there
/// is none.
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

double scale_to(double side, const FrameFormat& format) {
  return std::min(1.0, side / std::max(format.width_px, format.height_px));
}

cv::Mat gray_of(const ImageView& image) {
  cv::Mat gray(image.format.height_px, image.format.width_px, CV_8UC1);
  for (int v = 0; v < gray.rows; ++v) gray_row(image, v, 0, gray.cols, gray.ptr(v));
  return gray;
}

/// How much more detail there is just inside the ring than just outside, from -1 to 1. Outside the image there is none.
double contrast(const EdgeMap& map, const ImageCircle& ring) {
  const double inside = detail_between(map, ring, 0.90, 0.97), outside = detail_between(map, ring, 1.03, 1.10);
  if (std::isnan(inside)) return 0.0;
  return std::isnan(outside) ? 1.0 : (inside - outside) / (inside + outside + 1e-9);
}

double clearness(const EdgeMap& map, const ImageCircle& ring) {
  const std::size_t reach = rim_reach(ring.radius, 1.0);
  RingProfile profile;
  const ImageCircle first{ring.u, ring.v, ring.radius - static_cast<double>(reach)};
  read_profile(map, first, 1.0, 2 * reach + 2, RayFan(360), profile);
  return rim_score(profile, reach);
}

struct Candidate {
  CircleFit fit;
  double clearness = 0.0, contrast = 0.0;

  bool is_mirror() const {
    return clearness >= kLeastClearness && fit.seen >= kLeastSeen && contrast >= kLeastContrast;
  }
  double rank() const { return clearness * contrast * fit.seen; }
};

Candidate examine(const EdgeMap& coarse, const EdgeMap& fine, const ImageCircle& rough) {
  const double up = fine.scale / coarse.scale;
  const ImageCircle start{fine.to_map(coarse.to_image(rough.u)), fine.to_map(coarse.to_image(rough.v)),
                          rough.radius * up};
  Candidate candidate;
  candidate.fit = fit_circle(fine, best_rim_near(fine, start, 1.5 * up));
  candidate.clearness = clearness(fine, candidate.fit.ring);
  candidate.contrast = contrast(fine, candidate.fit.ring);
  return candidate;
}

Circle in_image(const EdgeMap& map, const ImageCircle& ring) {
  return {{map.to_image(ring.u), map.to_image(ring.v)}, ring.radius / map.scale};
}

/// The ring refined by a fit to its edge, if the edge is clear enough; else the ring of the search.
ImageCircle sharpened(const EdgeMap& map, const ImageCircle& ring) {
  const CircleFit fit = fit_circle(map, ring);
  return fit.seen >= kLeastSeen ? fit.ring : ring;
}

MirrorCircle mirror_of(const EdgeMap& map, const Candidate& candidate) {
  const CircleFit& fit = candidate.fit;
  MirrorCircle mirror{.rim = in_image(map, fit.ring),
                      .sigma_centre_px = fit.sigma_centre / map.scale,
                      .sigma_radius_px = fit.sigma_radius / map.scale,
                      .rim_in_image = fit.in_map,
                      .rim_seen = fit.seen,
                      .clearness = candidate.clearness,
                      .inner = std::nullopt};
  if (const ImageCircle disc = inner_disc(map, fit.ring); disc.radius > 0.0)
    mirror.inner = in_image(map, sharpened(map, disc));
  return mirror;
}

}  // namespace

struct MirrorFinder::Maps {
  explicit Maps(const FrameFormat& first)
      : format(first), coarse(scale_to(kCoarseSide, first)), fine(scale_to(kFineSide, first)) {}
  FrameFormat format;
  int images = 0;
  EdgeMapBuilder coarse, fine;
};

MirrorFinder::MirrorFinder() = default;
MirrorFinder::~MirrorFinder() = default;
MirrorFinder::MirrorFinder(MirrorFinder&&) noexcept = default;
MirrorFinder& MirrorFinder::operator=(MirrorFinder&&) noexcept = default;

int MirrorFinder::images() const { return maps_ ? maps_->images : 0; }

bool MirrorFinder::add(const ImageView& image) {
  const FrameFormat& format = image.format;
  if (!image.readable() || std::min(format.width_px, format.height_px) < kLeastSide_px) return false;
  if (!maps_) maps_ = std::make_unique<Maps>(format);
  if (format.width_px != maps_->format.width_px || format.height_px != maps_->format.height_px) return false;
  const cv::Mat gray = gray_of(image);
  maps_->coarse.add(gray);
  maps_->fine.add(gray);
  ++maps_->images;
  return true;
}

std::optional<MirrorCircle> MirrorFinder::find() const {
  if (!maps_) return std::nullopt;
  const EdgeMap coarse = maps_->coarse.build(), fine = maps_->fine.build();
  std::optional<Candidate> best;
  for (const ImageCircle& rough : likely_rims(coarse, kCandidates)) {
    const Candidate candidate = examine(coarse, fine, rough);
    if (candidate.is_mirror() && (!best || candidate.rank() > best->rank())) best = candidate;
  }
  if (!best) return std::nullopt;
  return mirror_of(fine, *best);
}

}  // namespace azimuth
