#include "slam/fastslam/error_covariance.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>

#include "slam/geometry/index.hpp"

namespace azimuth {

using Matrix32d = Eigen::Matrix<double, 3, 2>;

ErrorCovariance::ErrorCovariance(std::size_t max_landmarks, std::size_t max_sightings,
                                 const Eigen::Vector2d& sigma_scales)
    : scale_variances_(sigma_scales.cwiseAbs2()), size_(kFirst) {
  const std::size_t most_ids = max_landmarks + as_size(kMostKept);
  const Index most = entry_of(most_ids) + 2 * as_index(max_sightings);
  P_ = Eigen::MatrixXd::Zero(most, most);
  D_ = Eigen::Matrix<double, Eigen::Dynamic, 2>::Zero(most, 2);
  columns_.resize(most, 3);
  ids_.reserve(most_ids);
  terms_.reserve(std::max(2 * max_sightings, as_size(kMostKept)) + 2);
  sights_.reserve(max_sightings);
}

template <int Size>
void ErrorCovariance::add_term(Index at, const Eigen::Matrix<double, 3, Size>& by) {
  Term& term = terms_.emplace_back(Term{at, Size, Eigen::Matrix3d::Zero()});
  term.by.leftCols<Size>() = by;
}

/// e_at <- sum of the terms, including the covariances of e_at with all other entries.
void ErrorCovariance::replace(Index at) {
  auto columns = columns_.topRows(size_);
  columns.setZero();
  for (const Term& term : terms_)
    for (Index i = 0; i < term.size; ++i)
      for (Index k = 0; k < 3; ++k) columns.col(k) += term.by(k, i) * P_.col(term.at + i).head(size_);
  Eigen::Matrix3d own = Eigen::Matrix3d::Zero();
  ByScales by_scales = ByScales::Zero();
  for (const Term& term : terms_) by_scales += term.by.leftCols(term.size) * D_.middleRows(term.at, term.size);
  D_.middleRows<3>(at) = by_scales;
  for (const Term& term : terms_) own += term.by.leftCols(term.size) * columns.middleRows(term.at, term.size);
  P_.block(0, at, size_, 3) = columns;
  P_.block(at, 0, 3, size_) = columns.transpose();
  P_.block<3, 3>(at, at) = 0.5 * (own + own.transpose());
  terms_.clear();
}

void ErrorCovariance::predict(const MovedPose& moved) {
  size_ = entry_of(ids_.size());
  add_term<3>(kPose, moved.G);
  replace(kPose);
  P_.topLeftCorner<3, 3>() += moved.noise;
  D_.topRows<3>() += moved.by_scales;
}

void ErrorCovariance::begin_image(std::size_t sightings) {
  const Index first = entry_of(ids_.size()), count = 2 * as_index(sightings);
  size_ = first + count;
  P_.block(0, first, size_, count).setZero();
  P_.block(first, 0, count, size_).setZero();
  D_.middleRows(first, count).setZero();
  sights_.clear();
}

void ErrorCovariance::sight(std::size_t sighting, std::int64_t landmark, const LampView& from_x_hat,
                            const Symmetric3& Sigma, const Symmetric2& noise) {
  const std::size_t index = index_of(landmark);
  if (index == kNone) return;
  const Symmetric2 Q = from_x_hat.of_point(Sigma) + noise;
  sights_.push_back({noise_of(sighting), entry_of(index), from_x_hat.H_x(), from_x_hat.H_m(), Q.matrix().inverse()});
  P_.block<2, 2>(noise_of(sighting), noise_of(sighting)) = noise.matrix();
}

void ErrorCovariance::draw(const Symmetric3& proposal) {
  const Eigen::Matrix3d P = proposal.matrix();
  Eigen::Matrix3d kept = Eigen::Matrix3d::Identity();
  for (const Sight& sight : sights_) {
    const Matrix32d K = P * sight.H_x.transpose() * sight.over_Q;
    kept -= K * sight.H_x;
    add_term<3>(sight.landmark, -K * sight.H_m);
    add_term<2>(sight.noise, K);
  }
  add_term<3>(kPose, kept);
  replace(kPose);
  P_.topLeftCorner<3, 3>() += P;
}

void ErrorCovariance::learn(std::size_t sighting, std::int64_t landmark, const LampView& from_x_t,
                            const Symmetric3& Sigma, const Symmetric2& noise) {
  const std::size_t index = index_of(landmark);
  if (index == kNone) return;
  const Eigen::Matrix<double, 2, 3> H_m = from_x_t.H_m();
  const Eigen::Matrix2d Q = (from_x_t.of_point(Sigma) + noise).matrix();
  const Matrix32d K = Sigma.matrix() * H_m.transpose() * Q.inverse();
  P_.block<2, 2>(noise_of(sighting), noise_of(sighting)) = noise.matrix();
  add_term<3>(entry_of(index), Eigen::Matrix3d::Identity() - K * H_m);
  add_term<3>(kPose, -K * from_x_t.H_x());
  add_term<2>(noise_of(sighting), K);
  replace(entry_of(index));
}

void ErrorCovariance::keep_pose(std::int64_t step) {
  remove_if([step](std::int64_t id) { return is_pose(id) && id >= id_of_pose(step - kMostKept); });
  add_term<3>(kPose, Eigen::Matrix3d::Identity());
  add(id_of_pose(step), Symmetric3{});
}

void ErrorCovariance::mapped_from(std::int64_t step, const Eigen::Matrix3d& by_pose) {
  const std::size_t index = index_of(id_of_pose(step));
  assert(index != kNone);
  add_term<3>(entry_of(index), by_pose);
}

void ErrorCovariance::add(std::int64_t landmark, const Symmetric3& own) {
  const Index at = entry_of(ids_.size());
  size_ = at + 3;
  assert(size_ <= P_.rows());
  P_.block(0, at, size_, 3).setZero();
  P_.block(at, 0, 3, size_).setZero();
  replace(at);
  P_.block<3, 3>(at, at) += own.matrix();
  ids_.push_back(landmark);
}

void ErrorCovariance::add(std::int64_t landmark, const Pose2& T_map_body, const Eigen::Vector3d& p_map,
                          const Symmetric3& own) {
  const Eigen::Vector2d arm = p_map.head<2>() - T_map_body.position();
  add_term<3>(kPose, Eigen::Matrix3d{{1.0, 0.0, -arm.y()}, {0.0, 1.0, arm.x()}, {0.0, 0.0, 0.0}});
  add(landmark, own);
}

/// The last entry moves to the place of the removed one.
void ErrorCovariance::remove(std::size_t index) {
  size_ = entry_of(ids_.size());
  const Index at = entry_of(index), last = size_ - 3;
  if (at != last) {
    P_.block(0, at, size_, 3) = P_.block(0, last, size_, 3);
    P_.block(at, 0, 3, size_) = P_.block(last, 0, 3, size_);
    P_.block<3, 3>(at, at) = P_.block<3, 3>(last, last);
    D_.middleRows<3>(at) = D_.middleRows<3>(last);
  }
  ids_[index] = ids_.back();
  ids_.pop_back();
  size_ = last;
}

std::size_t ErrorCovariance::index_of(std::int64_t id) const {
  const auto found = std::ranges::find(ids_, id);
  return found == ids_.end() ? kNone : as_size(found - ids_.begin());
}

Eigen::Matrix3d ErrorCovariance::landmark(std::int64_t landmark) const {
  const std::size_t index = index_of(landmark);
  assert(index != kNone);
  const Index at = entry_of(index);
  const auto by_scales = D_.middleRows<3>(at);
  return P_.block<3, 3>(at, at) + by_scales * scale_variances_.asDiagonal() * by_scales.transpose();
}

void ErrorCovariance::restore(const MapSnapshot& map) {
  ids_.clear();
  std::vector<Index> entries{0, 1, 2};
  for (std::size_t i = 0; i < map.camera.size(); ++i) entries.push_back(-1);
  D_.topRows<3>().setZero();
  D_.col(0).head<2>() = map.T_map_body.position();
  for (const MapLandmark& landmark : map.landmarks) {
    const Index at = entry_of(ids_.size());
    D_.middleRows<3>(at).setZero();
    D_.col(0).segment<2>(at) = landmark.p_map_landmark_m;
    for (Index k = 0; k < 3; ++k) entries.push_back(at + k);
    ids_.push_back(landmark.id);
  }
  size_ = entry_of(ids_.size());
  P_.topLeftCorner(size_, size_).setZero();
  for (std::size_t row = 0; row < entries.size(); ++row)
    for (std::size_t column = 0; column < entries.size(); ++column)
      if (entries[row] >= 0 && entries[column] >= 0) P_(entries[row], entries[column]) = map.covariance(row, column);
}

void ErrorCovariance::place_pose(const Eigen::Matrix3d& covariance) {
  remove_if(is_pose);
  size_ = entry_of(ids_.size());
  P_.block(0, kPose, size_, 3).setZero();
  P_.block(kPose, 0, 3, size_).setZero();
  P_.topLeftCorner<3, 3>() = covariance;
  D_.topRows<3>().setZero();
}

void ErrorCovariance::save(const MovedPose& moved, MapSnapshot& out) const {
  constexpr std::size_t kPoseEntries = MapSnapshot::kPoseEntries;
  out.covariance.resize(out.entries());
  const Eigen::Matrix3d of_pose = moved.G * pose() * moved.G.transpose() + moved.noise;
  for (std::size_t i = 0; i < kPoseEntries; ++i)
    for (std::size_t k = 0; k <= i; ++k) out.covariance(i, k) = of_pose(as_index(i), as_index(k));
  for (std::size_t a = 0; a < out.landmarks.size(); ++a) {
    const Index at = entry_of(index_of(out.landmarks[a].id));
    const std::size_t row = kPoseEntries + 3 * a;
    const Eigen::Matrix3d with_pose = P_.block<3, 3>(at, kPose) * moved.G.transpose();
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) out.covariance(row + i, k) = with_pose(as_index(i), as_index(k));
    for (std::size_t b = 0; b <= a; ++b) {
      const Index other = entry_of(index_of(out.landmarks[b].id));
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < (a == b ? i + 1 : 3); ++k)
          out.covariance(row + i, kPoseEntries + 3 * b + k) = P_(at + as_index(i), other + as_index(k));
    }
  }
}

}  // namespace azimuth
