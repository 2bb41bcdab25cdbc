#include "tools/lens_fit/lamp_tracking.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace azimuth {
namespace {

constexpr double kNewLampsFrom = 2.5;  // largest horizontal distance of a new lamp, in lamp heights
constexpr std::size_t kOften = 8;      // least number of observations of a lamp that is used

struct Followed {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
};

struct Match {
  std::size_t seen, lamp;
};

class Follower {
 public:
  Follower(const Lens& lens, double lamp_height_m, const TrackingGate& trust)
      : lens_(lens), height_m_(lamp_height_m), trust_(trust) {}

  void go(const Motion& motion, const SeenLamps& seen) {
    pose_ = pose_ * motion.T_start_end;
    std::vector<Match> matches = matched(seen);
    for (int i = 0; i < 3 && !matches.empty(); ++i) settle(motion, seen, matches);
    matches = matched(seen);
    std::vector<bool> known(seen.size());
    for (const Match& match : matches) {
      known[match.seen] = true;
      note(seen[match.seen], match.lamp);
      learn(seen[match.seen], match.lamp);
    }
    for (std::size_t i = 0; i < seen.size(); ++i)
      if (!known[i]) add(seen[i]);
    poses_.push_back(pose_);
  }

  LensFitStart done(const std::vector<Motion>& motions) && {
    LensFitStart map;
    map.drive.motions = motions;
    map.start.lens = lens_;
    map.start.lamp_height_m = height_m_;
    const Pose2 T_first_map = inverse(poses_.front());
    for (const Pose2& pose : poses_) map.start.T_map_body.push_back(T_first_map * pose);
    std::vector<std::size_t> times(lamps_.size()), names(lamps_.size());
    for (const LampObservation& each : sightings_) ++times[each.lamp];
    for (std::size_t i = 0; i < lamps_.size(); ++i) {
      names[i] = map.start.lamps.size();
      if (times[i] < kOften) continue;
      const Eigen::Vector2d place = T_first_map * lamps_[i].place;
      map.start.lamps.emplace_back(place.x(), place.y(), 0.0);
    }
    for (LampObservation& each : sightings_) {
      if (times[each.lamp] < kOften) continue;
      each.lamp = names[each.lamp];
      map.drive.sightings.push_back(each);
    }
    map.cost = count_ > 0.0 ? cost_ / count_ : 1.0;
    return map;
  }

 private:
  Eigen::Vector3d seen_from(const Pose2& pose, std::size_t lamp) const {
    Eigen::Vector3d point;
    point << inverse(pose) * lamps_[lamp].place, height_m_;
    return point;
  }
  std::optional<Lens::Image> image(std::size_t lamp, const Pixel& about) const {
    return lens_.image(seen_from(pose_, lamp), lens_.axes.polar(about).radius_px);
  }

  /// Pairs of mutual nearest neighbours within the gate. Any rival must be more than twice as far away.
  std::vector<Match> matched(const SeenLamps& seen) const {
    std::vector<Match> matches;
    std::vector<std::optional<Pixel>> expected(lamps_.size());
    for (std::size_t k = 0; k < lamps_.size(); ++k) {
      const Eigen::Vector3d point = seen_from(pose_, k);
      const double theta = std::atan2(point.head<2>().norm(), point.z());
      if (const auto found = lens_.image(point, lens_.radius_px * theta / kPi * 2.0)) expected[k] = found->pixel;
    }
    for (std::size_t i = 0; i < seen.size(); ++i) {
      double nearest = std::numeric_limits<double>::infinity(), second = nearest;
      std::size_t lamp = 0;
      for (std::size_t k = 0; k < expected.size(); ++k) {
        if (!expected[k]) continue;
        const double away_px = (*expected[k] - seen[i].pixel).norm();
        if (away_px < nearest) {
          second = std::exchange(nearest, away_px);
          lamp = k;
        } else {
          second = std::min(second, away_px);
        }
      }
      if (!(nearest < trust_.gate_px && second > 2.0 * nearest)) continue;
      const bool best = std::ranges::all_of(seen, [&](const SeenLamp& other) {
        return &other == &seen[i] || (*expected[lamp] - other.pixel).norm() > 2.0 * nearest;
      });
      if (best) matches.push_back({i, lamp});
    }
    return matches;
  }

  /// One Gauss-Newton step for the pose, from odometry and the matched lamps.
  void settle(const Motion& motion, const SeenLamps& seen, const std::vector<Match>& matches) {
    const Pose2 before = poses_.empty() ? Pose2{} : poses_.back();
    const MovedPose moved = apply(before, motion);
    constexpr double kLeast = 1e-3;
    Eigen::Matrix3d A = (moved.noise + kLeast * kLeast * Eigen::Matrix3d::Identity()).inverse();
    Eigen::Vector3d off = pose_.vector() - moved.T_map_body.vector();
    off.z() = wrap(off.z());
    Eigen::Vector3d b = -A * off;
    for (const Match& match : matches) {
      const Eigen::Vector3d point = seen_from(pose_, match.lamp);
      const auto expected = image(match.lamp, seen[match.seen].pixel);
      if (!expected) continue;
      const double cos = std::cos(pose_.heading_rad), sin = std::sin(pose_.heading_rad);
      Eigen::Matrix3d by_pose = Eigen::Matrix3d::Zero();
      by_pose.topRows<2>() << -cos, -sin, point.y(), sin, -cos, -point.x();
      const Eigen::Matrix<double, 2, 3> J = expected->by_point * by_pose;
      const Eigen::Matrix2d R = trust_.sigma_px * trust_.sigma_px * Eigen::Matrix2d::Identity() +
                                expected->by_point.leftCols<2>() * lamps_[match.lamp].information.inverse() *
                                    expected->by_point.leftCols<2>().transpose();
      const Eigen::Matrix<double, 3, 2> weighted = J.transpose() * R.inverse();
      A += weighted * J;
      b += weighted * (seen[match.seen].pixel - expected->pixel);
    }
    const Eigen::Vector3d step = A.ldlt().solve(b);
    pose_ = {pose_.x_m + step.x(), pose_.y_m + step.y(), wrap(pose_.heading_rad + step.z())};
  }

  void note(const SeenLamp& seen, std::size_t lamp) {
    sightings_.push_back({poses_.size(), lamp, seen.pixel, seen.covariance_px2});
  }

  Eigen::Matrix2d by_place(const Lens::Image& image) const {
    const double cos = std::cos(pose_.heading_rad), sin = std::sin(pose_.heading_rad);
    return image.by_point.leftCols<2>() * Eigen::Matrix2d{{cos, sin}, {-sin, cos}};
  }
  void learn(const SeenLamp& seen, std::size_t lamp) {
    const auto expected = image(lamp, seen.pixel);
    if (!expected) return;
    const Eigen::Matrix2d J = by_place(*expected) / trust_.sigma_px;
    const Eigen::Vector2d off = seen.pixel - expected->pixel;
    Followed& followed = lamps_[lamp];
    followed.information += J.transpose() * J;
    followed.place += followed.information.inverse() * (J.transpose() * off) / trust_.sigma_px;
    cost_ += off.squaredNorm() / (trust_.gate_px * trust_.gate_px);
    ++count_;
  }

  void add(const SeenLamp& seen) {
    ++count_;
    ++cost_;
    const auto beside = lens_.on_plane(seen.pixel, height_m_);
    if (!beside || beside->norm() > kNewLampsFrom * height_m_) return;
    lamps_.push_back({pose_ * *beside, Eigen::Matrix2d::Zero()});
    const auto expected = image(lamps_.size() - 1, seen.pixel);
    if (!expected) return lamps_.pop_back();
    const Eigen::Matrix2d J = by_place(*expected) / trust_.sigma_px;
    lamps_.back().information = J.transpose() * J;
    note(seen, lamps_.size() - 1);
  }

  Lens lens_;
  double height_m_;
  TrackingGate trust_;
  Pose2 pose_;
  std::vector<Pose2> poses_;
  std::vector<Followed> lamps_;
  std::vector<LampObservation> sightings_;
  double cost_ = 0.0, count_ = 0.0;
};

}  // namespace

LensFitStart map_lamps(const std::vector<Motion>& motions, const std::vector<SeenLamps>& images, const Lens& lens,
                       double lamp_height_m, const TrackingGate& trust) {
  Follower follower(lens, lamp_height_m, trust);
  for (std::size_t i = 0; i < images.size(); ++i) follower.go(i == 0 ? Motion{} : motions[i], images[i]);
  return std::move(follower).done(motions);
}

}  // namespace azimuth
