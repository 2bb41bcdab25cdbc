// The joint prior from a saved map: one term of many unknowns.

#include <algorithm>
#include <cassert>
#include <utility>

#include "slam/smoother/bearing_graph.hpp"

namespace azimuth {
namespace {

/// The deviation of a landmark or pose from its remembered mean.
Eigen::Vector2d off_of(const SmoothedLandmark& landmark, const Eigen::Vector2d& mean) {
  return {wrap(landmark.direction_rad - mean.x()), landmark.inverse_distance_per_m - mean.y()};
}
Eigen::Vector3d off_of(const Pose2& pose, const Eigen::Vector3d& mean) {
  return {pose.x_m - mean.x(), pose.y_m - mean.y(), wrap(pose.heading_rad - mean.z())};
}

/// d(x, y, heading) / d(along, left, turn)
Eigen::Matrix3d to_map(const SmoothedPose& pose) {
  Eigen::Matrix3d by_step = Eigen::Matrix3d::Identity();
  by_step.topLeftCorner<2, 2>() << pose.forwards.x(), -pose.forwards.y(), pose.forwards.y(), pose.forwards.x();
  return by_step;
}

}  // namespace

LandmarkId BearingGraph::add_known_landmark(const SmoothedLandmark& state) {
  const auto id = landmarks_.size();
  LandmarkEntry landmark;
  landmark.state = state;
  landmark.known = true;
  landmark.block = add_block(Kind::landmark, id, 2);
  landmarks_.push_back(landmark);
  return id;
}

void BearingGraph::remember(Remembered remembered) {
  assert(remembered_blocks_.empty());
  remembered_ = std::make_shared<const Remembered>(std::move(remembered));
  list_remembered_blocks();
}

void BearingGraph::list_remembered_blocks() {
  remembered_blocks_.clear();
  if (remembered_->pose > 0) remembered_blocks_.push_back(poses_[remembered_->pose].block);
  for (const LandmarkId id : remembered_->landmarks) remembered_blocks_.push_back(landmarks_[id].block);
}

void BearingGraph::sum_remembered() {
  const Remembered& known = *remembered_;
  if (remembered_blocks_.empty()) return;
  Eigen::VectorXd off(known.mean.size());
  Eigen::Index at = 0;
  if (known.pose > 0) {
    off.head<3>() = off_of(pose(known.pose), known.mean.head<3>());
    at = 3;
  }
  for (const LandmarkId id : known.landmarks) {
    off.segment<2>(at) = off_of(landmark(id), known.mean.segment<2>(at));
    at += 2;
  }
  Eigen::VectorXd pull = known.information * off;
  energy_ += 0.5 * off.dot(pull);
  at = 0;
  if (known.pose > 0) {
    const PoseEntry& pose = poses_[known.pose];
    gradient_.segment<3>(first_row(pose.block)) += to_map(pose.state).transpose() * pull.head<3>();
    at = 3;
  }
  for (const LandmarkId id : known.landmarks) {
    gradient_.segment<2>(first_row(landmarks_[id].block)) += pull.segment<2>(at);
    at += 2;
  }
}

bool BearingGraph::is_remembered(Block block) const {
  const BlockEntry& entry = blocks_[block];
  if (entry.kind == Kind::landmark) return landmarks_[entry.id].known;
  return entry.kind == Kind::pose && entry.id > 0 && entry.id == remembered_->pose;
}

void BearingGraph::append_remembered(Block block, std::vector<Block>& out) const {
  for (const Block other : remembered_blocks_)
    if (other != block) out.push_back(other);
}

/// The derivatives use the remembered heading of the pose, so the matrix is constant. The gradient is exact.
void BearingGraph::add_remembered(Block block, FrontMatrix& front) const {
  const Remembered& known = *remembered_;
  const auto turned = [&](Block of, Eigen::MatrixXd part, bool by_rows) -> Eigen::MatrixXd {
    if (size(of) != 3) return part;
    const Eigen::Matrix3d by_step = to_map(SmoothedPose({known.mean.x(), known.mean.y(), known.mean.z()}));
    return by_rows ? Eigen::MatrixXd(by_step.transpose() * part) : Eigen::MatrixXd(part * by_step);
  };
  const auto start_of = [&](std::size_t entry) {
    const Eigen::Index of_pose = known.pose > 0 ? 1 : 0, i = static_cast<Eigen::Index>(entry);
    return i < of_pose ? 0 : 3 * of_pose + 2 * (i - of_pose);
  };
  const auto entry = static_cast<std::size_t>(std::find(remembered_blocks_.begin(), remembered_blocks_.end(), block) -
                                              remembered_blocks_.begin());
  const int row = front.row_of(first_row(block));
  for (std::size_t other = 0; other < remembered_blocks_.size(); ++other) {
    const Block later = remembered_blocks_[other];
    const int later_row = front.row_of(first_row(later));
    if (later_row < row) continue;
    Eigen::MatrixXd part = known.information.block(start_of(other), start_of(entry), size(later), size(block));
    part = turned(block, turned(later, std::move(part), true), false);
    front.add(later_row, row, part);
  }
}

}  // namespace azimuth
