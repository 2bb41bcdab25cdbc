#include "slam/perception/calibration/mirror_finder.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "slam/perception/calibration/circle_fit.hpp"
#include "slam/perception/calibration/edge_map.hpp"
#include "slam/perception/calibration/ring_search.hpp"
#include "slam/perception/image/gray.hpp"

namespace azimuth {
namespace {

constexpr double kCoarseSide = 192.0, kFineSide = 640.0;
constexpr std::size_t kCandidates = 16;

// Least values for a mirror. Circles that arise by chance from clutter fail at least one of them.
constexpr double kLeastClearness = 0.35, kLeastSeen = 0.6, kLeastContrast = 0.1;

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
