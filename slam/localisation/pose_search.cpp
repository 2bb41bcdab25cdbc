#include "slam/localisation/pose_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "slam/geometry/index.hpp"
#include "slam/geometry/same_everywhere.hpp"

namespace azimuth {

namespace {

constexpr double kSamePlace_m = 1e-3;
// Lower limit for the sine of the angle at which the two circles intersect.
constexpr double kTouching = 0.02;

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/* Let q be landmark a relative to landmark b, and gamma the angle from a's direction to b's. The positions p (relative
 * to b) from which the landmarks are seen like this form a circle through both: Im[conj(q - p) (0 - p) e^(-i gamma)] =
 * 0, which is
 *   sin(gamma) |p|^2 = l . p,   l = (sin(gamma) q_x + cos(gamma) q_y, sin(gamma) q_y - cos(gamma) q_x) */
struct Circle {
  Eigen::Vector2d l;
  double sine;
};

Circle circle(const Eigen::Vector2d& q, const Eigen::Vector2d& to_a, const Eigen::Vector2d& to_b) {
  const double s = cross(to_a, to_b), c = to_a.dot(to_b);
  return {{s * q.x() + c * q.y(), s * q.y() - c * q.x()}, s};
}

/// The second intersection of two circles that both pass through the origin.
std::optional<Eigen::Vector2d> crossing(const Circle& a, const Circle& b) {
  const Eigen::Vector2d normal = b.sine * a.l - a.sine * b.l;  // normal of the line through both intersections
  if (normal.squaredNorm() <= kTouching * kTouching * std::sqrt(a.l.squaredNorm() * b.l.squaredNorm()))
    return std::nullopt;
  const Eigen::Vector2d line(-normal.y(), normal.x());
  const Circle& rounder = std::abs(a.sine) > std::abs(b.sine) ? a : b;
  if (std::abs(rounder.sine) < kTouching) return std::nullopt;
  return rounder.l.dot(line) / (rounder.sine * line.squaredNorm()) * line;
}

}  // namespace

std::optional<Pose2> pose_from_pair(const std::array<Eigen::Vector2d, 2>& p_map,
                                    const std::array<Eigen::Vector2d, 2>& p_body) {
  const Eigen::Vector2d in_map = p_map[1] - p_map[0], in_body = p_body[1] - p_body[0];
  if (in_map.norm() < kSamePlace_m || in_body.norm() < kSamePlace_m) return std::nullopt;
  Pose2 T_map_body{0.0, 0.0, std::atan2(cross(in_body, in_map), in_body.dot(in_map))};
  const Eigen::Vector2d p = 0.5 * (p_map[0] + p_map[1]) - T_map_body * Eigen::Vector2d(0.5 * (p_body[0] + p_body[1]));
  T_map_body.x_m = p.x();
  T_map_body.y_m = p.y();
  return T_map_body;
}

std::optional<Pose2> pose_from_directions(const std::array<Eigen::Vector2d, 3>& p_map,
                                          const std::array<Eigen::Vector2d, 3>& to_landmark) {
  const auto from_middle = crossing(circle(p_map[0] - p_map[1], to_landmark[0], to_landmark[1]),
                                    circle(p_map[2] - p_map[1], to_landmark[2], to_landmark[1]));
  if (!from_middle || from_middle->squaredNorm() < kSamePlace_m * kSamePlace_m) return std::nullopt;
  const Eigen::Vector2d p = p_map[1] + *from_middle, to_middle = -*from_middle;
  // Heading, times a length: the rotation of the middle direction to the middle landmark.
  const double c = to_landmark[1].dot(to_middle), s = cross(to_landmark[1], to_middle);
  for (const std::size_t i : {0u, 2u}) {
    const Eigen::Vector2d& d = to_landmark[i];
    if (!(Eigen::Vector2d(c * d.x() - s * d.y(), s * d.x() + c * d.y()).dot(p_map[i] - p) > 0.0)) return std::nullopt;
  }
  return Pose2{p.x(), p.y(), std::atan2(s, c)};
}

namespace {

constexpr double kTolerance_sigmas = 3.0;
constexpr double kTolerance_rad = 0.02;  // margin for the error of a pose computed from two or three directions
constexpr double kApart_m = 0.3, kApart_rad = 0.1;
// limit of right samples per image, since a common cause may spoil all samples of an image
constexpr double kMostOfAnImage = 1.5;
constexpr int kChecksPerPose = 5;  // cost of computing one pose
/// Whether the two landmarks cannot be seen from one pose.
bool are_too_far_apart(const KnownMap& map, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double most_m = 2.2 * map.view.max_distance_m;
  return map.tan_min_elevation <= 0.0 && (a - b).squaredNorm() > most_m * most_m;
}

constexpr double kLowest_rad = 0.02;  // lower elevations do not determine a distance

/// Horizontal position, relative to the robot, of a landmark one metre above the camera.
Eigen::Vector2d per_metre(const SeenRay& ray) { return ray.along.head<2>() / ray.along.z(); }

/// Upper bound of the standard deviation of per_metre().
double sigma_per_metre(const SeenRay& ray) {
  const double sine = ray.along.z();
  return std::max(std::sqrt(ray.variance_across) / sine, std::sqrt(ray.variance_up) / (sine * sine));
}

bool can_give_distance(const SeenRay& ray) { return ray.spatial && ray.along.z() > kLowest_rad; }

double above_camera(const KnownMap& map, std::size_t landmark) {
  return map.landmarks[landmark].p_map_m.z() - map.view.height_m;
}

}  // namespace

PoseSearch::PoseSearch(const RelocalisationSettings& settings)
    : settings_(settings), bits_(static_cast<std::uint64_t>(settings.seed)) {
  kept_.reserve(as_size(settings.refined_poses) + 1);
}

void PoseSearch::restart() {
  bits_ = SplitMix(static_cast<std::uint64_t>(settings_.seed));
  right_samples_ = 0.0;
}

std::span<const SuggestedPose> PoseSearch::suggest(const KnownMap& map, const RaysOfImage& image, double mapped_share,
                                                   const SearchArea& area) {
  kept_.clear();
  area_ = area;
  mapped_share_ = mapped_share;
  checks_left_ = settings_.search_checks;
  right_here_ = 0.0;
  prepare(map, image);
  if (has_spatial_pairs(map))
    search_pairs(map, image);
  else
    search_triples(map, image);
  right_samples_ += std::min(right_here_, kMostOfAnImage);
  return kept_;
}

void PoseSearch::prepare(const KnownMap& map, const RaysOfImage& image) {
  usable_.clear();
  candidates_.clear();
  first_candidate_.assign(1, 0);
  weight_.clear();
  flat_.clear();
  tolerance_.clear();
  ray_pairs_.clear();
  all_weights_ = 0.0;
  for (std::size_t r = 0; r < image.rays.size(); ++r) {
    const SeenRay& ray = image.rays[r];
    flat_.emplace_back(std::cos(ray.seen.azimuth_rad), std::sin(ray.seen.azimuth_rad));
    for (std::size_t l = 0; l < map.landmarks.size(); ++l)
      if (may_be(ray.seen, map.landmarks[l])) candidates_.push_back(static_cast<std::uint32_t>(l));
    first_candidate_.push_back(candidates_.size());
    // A rare name is stronger evidence than one that half of the map has.
    const std::size_t alike = first_candidate_[r + 1] - first_candidate_[r];
    const auto all = static_cast<double>(map.landmarks.size());
    weight_.push_back(alike == 0 ? 0.0 : 1.0 + std::log(all / static_cast<double>(alike)));
    all_weights_ += weight_.back();
    tolerance_.push_back(kTolerance_sigmas * std::sqrt(std::max(ray.variance_across, ray.variance_up)) +
                         kTolerance_rad);
    if (alike == 0) continue;
    usable_.push_back(r);
    for (std::size_t other = 0; other < r; ++other)
      if (can_give_distance(ray) && can_give_distance(image.rays[other]) && weight_[other] > 0.0)
        ray_pairs_.emplace_back(other, r);
  }
  from_camera_.resize(map.landmarks.size());
}

bool PoseSearch::has_spatial_pairs(const KnownMap& map) const { return !map.pairs.empty() && !ray_pairs_.empty(); }

void PoseSearch::search_pairs(const KnownMap& map, const RaysOfImage& image) {
  for (std::size_t i = ray_pairs_.size(); i-- > 1;) std::swap(ray_pairs_[i], ray_pairs_[bits_.index(i + 1)]);
  for (std::size_t i = 0; i < ray_pairs_.size() && checks_left_ > 0; ++i) try_pair(map, image, ray_pairs_[i]);
}

/// Tries the pairs of landmarks whose distance agrees with the two directions, for heights between `low` and `high`
/// above the camera.
void PoseSearch::try_pair(const KnownMap& map, const RaysOfImage& image, RayPair rays) {
  double low_m = std::numeric_limits<double>::infinity(), high_m = 0.0;
  for (std::size_t l = 0; l < map.landmarks.size(); ++l)
    if (map.landmarks[l].has_height()) {
      low_m = std::min(low_m, above_camera(map, l));
      high_m = std::max(high_m, above_camera(map, l));
    }
  low_m = std::max(low_m, 0.0);
  const SeenRay &first = image.rays[rays.first], &second = image.rays[rays.second];
  const Eigen::Vector2d u = per_metre(first), w = per_metre(second);
  const double middle_m = 0.5 * (low_m + high_m), spread_m = 0.5 * (high_m - low_m);
  const double sigma_m = high_m * hypotenuse(sigma_per_metre(first), sigma_per_metre(second));
  const double distance_m = middle_m * (u - w).norm();
  const double margin_m = spread_m * (u.norm() + w.norm()) + kTolerance_sigmas * sigma_m + kApart_m;
  const auto pairs = map.pairs.between(distance_m - margin_m, distance_m + margin_m);
  if (pairs.empty()) return;
  checks_left_ -= static_cast<std::ptrdiff_t>(map.landmarks.size());
  // Tries all pairs if there is time, else a part of them from a random start, since other directions need their turn.
  const std::ptrdiff_t stop = checks_left_ - settings_.search_checks / 4;
  const std::size_t start = bits_.index(pairs.size());
  std::size_t i = 0;
  for (; i < pairs.size() && checks_left_ > std::max<std::ptrdiff_t>(stop, 0); ++i) {
    const auto& pair = pairs[(start + i) % pairs.size()];
    try_lamps(map, image, rays, {pair.a, pair.b});
    try_lamps(map, image, rays, {pair.b, pair.a});
  }
  right_here_ += mapped_share_ * mapped_share_ * static_cast<double>(i) / static_cast<double>(pairs.size());
}

void PoseSearch::try_lamps(const KnownMap& map, const RaysOfImage& image, RayPair rays, RayPair lamps) {
  checks_left_ -= kChecksPerPose;
  const SeenRay &first = image.rays[rays.first], &second = image.rays[rays.second];
  const KnownLandmark &a = map.landmarks[lamps.first], &b = map.landmarks[lamps.second];
  if (!may_be(first.seen, a) || !may_be(second.seen, b)) return;
  const double up_a_m = above_camera(map, lamps.first), up_b_m = above_camera(map, lamps.second);
  if (up_a_m <= 0.0 || up_b_m <= 0.0) return;
  const Eigen::Vector2d from_body_a = up_a_m * per_metre(first), from_body_b = up_b_m * per_metre(second);
  const double sigma_m = hypotenuse(up_a_m * sigma_per_metre(first), up_b_m * sigma_per_metre(second)) +
                         std::sqrt(a.covariance_m2.trace() + b.covariance_m2.trace());
  const Eigen::Vector2d p_a = a.p_map_m.head<2>(), p_b = b.p_map_m.head<2>();
  if (std::abs((from_body_a - from_body_b).norm() - (p_a - p_b).norm()) > kTolerance_sigmas * sigma_m) return;
  if (const auto pose = pose_from_pair({p_a, p_b}, {from_body_a, from_body_b})) judge(map, image, *pose);
}

void PoseSearch::search_triples(const KnownMap& map, const RaysOfImage& image) {
  if (usable_.size() < 3 || map.landmarks.size() < 3) return;
  while (checks_left_ > 0) try_triple(map, image);
  // Repeating the same three directions does not help, so their number limits the right samples.
  const auto n = static_cast<double>(usable_.size());
  right_here_ = std::min(right_here_, std::pow(mapped_share_, 3.0) * n * (n - 1.0) * (n - 2.0) / 6.0);
}

void PoseSearch::try_triple(const KnownMap& map, const RaysOfImage& image) {
  checks_left_ -= kChecksPerPose;
  std::array<std::size_t, 3> rays{}, landmarks{};
  for (std::size_t& ray : rays) ray = usable_[bits_.index(usable_.size())];
  if (rays[0] == rays[1] || rays[0] == rays[2] || rays[1] == rays[2]) return;
  std::array<Eigen::Vector2d, 3> p_map, to_landmark;
  double right = 1.0;  // probability that this sample is right
  for (std::size_t i = 0; i < 3; ++i) {
    const auto may_be_of = candidates(rays[i]);
    landmarks[i] = may_be_of[bits_.index(may_be_of.size())];
    right *= mapped_share_ / static_cast<double>(may_be_of.size());
    p_map[i] = map.landmarks[landmarks[i]].p_map_m.head<2>();
    to_landmark[i] = flat_[rays[i]];
  }
  right_here_ += right;
  for (std::size_t i = 0; i < 3; ++i)
    if (const std::size_t j = (i + 1) % 3; landmarks[i] == landmarks[j] || are_too_far_apart(map, p_map[i], p_map[j]))
      return;
  const auto pose = pose_from_directions(p_map, to_landmark);
  if (!pose || !map.contains(*pose)) return;
  const CameraPlace from(*pose, map.view.height_m);
  for (const std::size_t l : landmarks)
    if (in_view(map, map.landmarks[l], from(map.landmarks[l])) == InView::no) return;
  judge(map, image, *pose);
}

void PoseSearch::judge(const KnownMap& map, const RaysOfImage& image, const Pose2& T_map_body) {
  if (!map.contains(T_map_body) || !area_.contains(T_map_body)) return;
  const double reached = score(map, image, T_map_body);
  if (reached > 0.0) keep({T_map_body, reached});
}

/// Sum of the weights of the directions that some landmark explains; 0 as soon as it cannot become large enough.
double PoseSearch::score(const KnownMap& map, const RaysOfImage& image, const Pose2& T_map_body) {
  const bool full = kept_.size() == as_size(settings_.refined_poses);
  const double enough = full ? kept_.back().score : 0.0;
  const CameraPlace from(T_map_body, map.view.height_m);
  for (std::size_t l = 0; l < map.landmarks.size(); ++l) from_camera_[l] = from(map.landmarks[l]);
  checks_left_ -= static_cast<std::ptrdiff_t>(map.landmarks.size());
  double missing = 0.0;
  for (const std::size_t r : usable_) {
    const SeenRay& ray = image.rays[r];
    const auto is_seen = [&](std::uint32_t l) {
      const Eigen::Vector3d& v = from_camera_[l];
      const double reach = tolerance_[r] * ray.along.dot(v);
      return std::abs(ray.across.dot(v)) < reach &&
             (!ray.spatial || !map.landmarks[l].has_height() || std::abs(ray.up.dot(v)) < reach) &&
             in_view(map, map.landmarks[l], v) != InView::no;
    };
    const auto may_be_of = candidates(r);
    checks_left_ -= static_cast<std::ptrdiff_t>(may_be_of.size());
    if (std::ranges::none_of(may_be_of, is_seen)) missing += weight_[r];
    if (all_weights_ - missing <= enough) return 0.0;
  }
  return all_weights_ - missing;
}

/// Keeps only the best of nearly equal poses.
void PoseSearch::keep(const SuggestedPose& pose) {
  const auto same = std::ranges::find_if(kept_, [&](const SuggestedPose& other) {
    return (other.T_map_body.position() - pose.T_map_body.position()).norm() < kApart_m &&
           std::abs(wrap(other.T_map_body.heading_rad - pose.T_map_body.heading_rad)) < kApart_rad;
  });
  if (same != kept_.end()) {
    if (same->score >= pose.score) return;
    kept_.erase(same);
  }
  const auto better = [](const SuggestedPose& a, const SuggestedPose& b) { return a.score > b.score; };
  kept_.insert(std::ranges::upper_bound(kept_, pose, better), pose);
  if (kept_.size() > as_size(settings_.refined_poses)) kept_.pop_back();
}

}  // namespace azimuth
