#include "slam/smoother/keyframe_limit.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace azimuth {
namespace {

constexpr double kNeeded = std::numeric_limits<double>::infinity();
// Share of a landmark's information. If less than this share remains, the landmark is undetermined.
constexpr double kAllOfIt = 1e-9;

/// The value of each pose: the information of its bearings on their landmarks, and the gap in the path without the
/// pose.
class Worths {
 public:
  Worths(const BearingGraph& graph, std::span<const std::int32_t> numbers, const ThinningRule& rule);

  bool may_be_forgotten(PoseId id) const {
    return id >= oldest_kept_ && id < first_kept_ && id != graph_.remembered().pose;
  }
  /// The value of a pose. It only grows while other poses are removed.
  double of(PoseId id) const;
  void forget(PoseId id);

 private:
  /// Information on a landmark's (alpha, rho), with the poses taken as known.
  struct Known {
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    std::size_t bearings = 0;
  };
  template <class Visit>
  void for_each_bearing(PoseId id, const Visit& visit) const {
    for (BearingId bearing = graph_.first_bearing_of(id); bearing < graph_.first_bearing_of(id + 1); ++bearing)
      if (const LandmarkId landmark = graph_.landmark_of(bearing);
          landmark != kOfNothing && graph_.chi2_of(bearing) < kFitsChi2)
        visit(graph_.by_landmark_of(bearing), static_cast<std::size_t>(landmark));
  }
  double told(PoseId id) const;
  double gap(PoseId id) const;
  double number(PoseId id) const { return static_cast<double>(numbers_[static_cast<std::size_t>(id)]); }

  const BearingGraph& graph_;
  std::span<const std::int32_t> numbers_;
  std::size_t fewest_bearings_;
  PoseId oldest_kept_, first_kept_;
  std::vector<Known> known_;            // per landmark
  std::vector<PoseId> before_, after_;  // per pose, its remaining neighbours
  double mean_told_ = 1.0, mean_gap_ = 1.0;
};

Worths::Worths(const BearingGraph& graph, std::span<const std::int32_t> numbers, const ThinningRule& rule)
    : graph_(graph),
      numbers_(numbers),
      fewest_bearings_(rule.fewest_bearings),
      oldest_kept_(static_cast<PoseId>(std::max(rule.oldest_kept, std::size_t{1}))),
      first_kept_(graph.poses() - static_cast<PoseId>(std::max(rule.newest_kept, std::size_t{1}))),
      known_(static_cast<std::size_t>(graph.landmarks())) {
  for (PoseId id = 0; id < graph.poses(); ++id) {
    before_.push_back(id - 1);
    after_.push_back(id + 1);
    for_each_bearing(id, [&](const Eigen::Vector2d& by, std::size_t landmark) {
      known_[landmark].information += by * by.transpose();
      ++known_[landmark].bearings;
    });
  }
  double sum = 0.0;
  int count = 0;
  for (PoseId id = 0; id < first_kept_; ++id)
    if (const double worth = told(id); may_be_forgotten(id) && worth < kNeeded) {
      sum += worth;
      ++count;
    }
  if (sum > 0.0) mean_told_ = sum / count;
  mean_gap_ = 2.0 * std::max(number(first_kept_) - number(0), 1.0) / std::max(first_kept_, 1);
}

/// Sum over the pose's bearings of the logarithm by which the landmark's uncertainty volume would grow without the
/// bearing. For a bearing with derivative j and a landmark with information L, this is -ln(1 - j^T L^-1 j).
double Worths::told(PoseId id) const {
  double worth = 0.0;
  for_each_bearing(id, [&](const Eigen::Vector2d& by, std::size_t landmark) {
    const Known& known = known_[landmark];
    const double left = 1.0 - by.dot(known.information.inverse() * by);
    worth += known.bearings <= fewest_bearings_ || !(left > kAllOfIt) ? kNeeded : -std::log(left);
  });
  return worth;
}

double Worths::gap(PoseId id) const {
  return number(after_[static_cast<std::size_t>(id)]) - number(before_[static_cast<std::size_t>(id)]);
}

double Worths::of(PoseId id) const { return told(id) / mean_told_ + gap(id) / mean_gap_; }

void Worths::forget(PoseId id) {
  for_each_bearing(id, [&](const Eigen::Vector2d& by, std::size_t landmark) {
    known_[landmark].information -= by * by.transpose();
    --known_[landmark].bearings;
  });
  const PoseId before = before_[static_cast<std::size_t>(id)], after = after_[static_cast<std::size_t>(id)];
  after_[static_cast<std::size_t>(before)] = after;
  before_[static_cast<std::size_t>(after)] = before;
}

// Removing poses orders and factorises everything anew, so many poses are removed at a time.
constexpr int kShareForgotten = 8;                  // one in so many
constexpr int kShareNewest = 4, kShareOldest = 32;  // one in so many is kept

}  // namespace

/// Removes the least valuable pose first. A value in the queue is a lower bound of the current value, so the first
/// entry whose value has not changed is the minimum.
std::vector<PoseId> least_worth(const BearingGraph& graph, std::span<const std::int32_t> numbers, std::size_t count,
                                const ThinningRule& rule) {
  Worths worths(graph, numbers, rule);
  using Entry = std::pair<double, PoseId>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> next;
  for (PoseId id = 0; id < graph.poses(); ++id)
    if (worths.may_be_forgotten(id)) next.emplace(worths.of(id), id);
  std::vector<PoseId> forgotten;
  while (!next.empty() && forgotten.size() < count) {
    const auto [entered, id] = next.top();
    next.pop();
    if (entered == kNeeded) break;
    if (const double now = worths.of(id); now > entered) {
      next.emplace(now, id);
      continue;
    }
    worths.forget(id);
    forgotten.push_back(id);
  }
  std::ranges::sort(forgotten);
  return forgotten;
}

KeyframeLimit::KeyframeLimit(int max_poses, std::size_t fewest_bearings)
    : max_poses_(max_poses),
      fewest_bearings_(fewest_bearings),
      most_(max_poses > 0 ? max_poses : std::numeric_limits<PoseId>::max()) {}

std::vector<PoseId> KeyframeLimit::least_worth(const BearingGraph& graph, std::span<const std::int32_t> numbers) const {
  const int too_many = graph.poses() - max_poses_ + at_a_time();
  const ThinningRule rule{.newest_kept = static_cast<std::size_t>(max_poses_ / kShareNewest),
                          .oldest_kept = static_cast<std::size_t>(max_poses_ / kShareOldest),
                          .fewest_bearings = fewest_bearings_};
  return azimuth::least_worth(graph, numbers, static_cast<std::size_t>(std::max(too_many, 0)), rule);
}

void KeyframeLimit::forgotten(const BearingGraph& graph) { most_ = std::max(max_poses_, graph.poses() + at_a_time()); }

int KeyframeLimit::at_a_time() const { return std::max(1, max_poses_ / kShareForgotten); }

}  // namespace azimuth
