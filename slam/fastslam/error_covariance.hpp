#pragma once
// Joint error covariance of a particle's pose and map (docs/mathematics.md II.11).

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "slam/fastslam/lamp_view.hpp"
#include "slam/fastslam/symmetric.hpp"
#include "slam/geometry/index.hpp"
#include "slam/geometry/motion.hpp"
#include "slam/geometry/pose2.hpp"
#include "slam/sample/map_snapshot.hpp"

namespace azimuth {

/// The joint covariance of the errors (estimate minus truth) of one particle: e_x of its pose, e_m of each landmark,
/// and the effect of the constant errors of the odometer's scales on both. The particle's own gains take the path as
/// exact when they update landmarks. Here all errors, with their correlations, pass through these same gains, and the
/// noise with which the pose is drawn is added.
///
/// Thread contract: thread-bound. Nothing allocates after construction.
class ErrorCovariance {
 public:
  using Index = Eigen::Index;

  /// `sigma_scales`: standard deviations of the odometer's scales, of distance and of turn.
  ErrorCovariance(std::size_t max_landmarks, std::size_t max_sightings, const Eigen::Vector2d& sigma_scales);

  /// e_x <- G e_x + B e_scales + w
  void predict(const MovedPose& moved);

  /// Begins an image with `sightings` detections, whose noise the pose and the landmarks share.
  void begin_image(std::size_t sightings);
  /// Registers that detection number `sighting` of the landmark with the id `landmark` moves the pose. `Sigma` is the
  /// landmark's covariance in the particle.
  void sight(std::size_t sighting, std::int64_t landmark, const LampView& from_x_hat, const Symmetric3& Sigma,
             const Symmetric2& noise);
  /// Applies all registered detections to the pose: e_x <- e_x + sum K_l (v_l - H_x e_x - H_m e_m) + s, where v_l is
  /// the noise of detection l, K_l = P H_x^T Q^-1, P is the proposal's covariance, Q = H_m Sigma H_m^T + noise, and s
  /// is drawn from N(0, P).
  void draw(const Symmetric3& proposal);
  /// Corrects the landmark's error by the detection from the drawn pose: e_m <- e_m + K (v_l - H_x e_x - H_m e_m),
  /// where K is the particle's gain and v_l the noise of the detection. `Sigma` is the landmark's covariance before the
  /// correction.
  void learn(std::size_t sighting, std::int64_t landmark, const LampView& from_x_t, const Symmetric3& Sigma,
             const Symmetric2& noise);

  /// Keeps only the landmarks for whose ids `contains` is true, and the kept poses.
  template <class Contains>
  void keep_if(const Contains& contains) {
    remove_if([&](std::int64_t id) { return !is_pose(id) && !contains(id); });
  }
  bool has(std::int64_t landmark) const { return index_of(landmark) != kNone; }
  /// Keeps the current pose under the number `step`, greater than that of the last one kept, after all detections of
  /// the image were learnt: a landmark may be mapped from it later. In every image, a kept pose costs as much as a
  /// landmark. Old poses are dropped.
  void keep_pose(std::int64_t step);
  bool keeps_pose(std::int64_t step) const { return has(id_of_pose(step)); }
  /// Begins a landmark that was mapped from kept poses: e_m = sum of all mapped_from() terms + an independent error.
  /// Call mapped_from() once for each pose, then add().
  void mapped_from(std::int64_t step, const Eigen::Matrix3d& by_pose);
  void add(std::int64_t landmark, const Symmetric3& own);
  /// Adds a landmark as if it had been mapped from this pose just now: it shares the pose's error; `own` is the
  /// covariance of its independent error.
  void add(std::int64_t landmark, const Pose2& T_map_body, const Eigen::Vector3d& p_map, const Symmetric3& own);

  /// Covariance of the pose without the effect of the scale errors.
  Eigen::Matrix3d pose() const { return P_.topLeftCorner<3, 3>(); }
  /// d(e_x) / d(e_scales): the effect of the scale errors on the pose up to now.
  ByScales by_scales() const { return D_.topRows<3>(); }
  const Eigen::Vector2d& scale_variances() const { return scale_variances_; }
  /// Covariance of an existing landmark, including the effect of the scale errors.
  Eigen::Matrix3d landmark(std::int64_t landmark) const;

  /// Starts from the pose and the landmarks of a map, whose size is proportional to the odometer's scale.
  void restore(const MapSnapshot& map);
  /// Makes the pose's error independent of the map, with the given covariance. Drops the kept poses.
  void place_pose(const Eigen::Matrix3d& covariance);
  /// Writes the covariance of the pose after `moved` and of the landmarks listed in `out`, in the layout of a saved
  /// map.
  void save(const MovedPose& moved, MapSnapshot& out) const;

 private:
  static constexpr std::int64_t kMostKept = 48;  // In steps
  static constexpr Index kPose = 0, kFirst = 3;
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  /// One term of a linear change: `by` times the entries from `at` on.
  struct Term {
    Index at, size;
    Eigen::Matrix3d by;
  };
  /// A detection that moves the pose.
  struct Sight {
    Index noise, landmark;
    Eigen::Matrix<double, 2, 3> H_x, H_m;
    Eigen::Matrix2d over_Q;
  };

  template <int Size>
  void add_term(Index at, const Eigen::Matrix<double, 3, Size>& by);
  void replace(Index at);
  void remove(std::size_t index);
  std::size_t index_of(std::int64_t id) const;
  template <class Goes>
  void remove_if(const Goes& goes) {
    for (std::size_t i = ids_.size(); i-- > 0;)
      if (goes(ids_[i])) remove(i);
  }
  // A kept pose is stored like a landmark, with a negative id.
  static std::int64_t id_of_pose(std::int64_t step) { return -1 - step; }
  static bool is_pose(std::int64_t id) { return id < 0; }
  static Index entry_of(std::size_t index) { return kFirst + 3 * as_index(index); }
  Index noise_of(std::size_t sighting) const { return entry_of(ids_.size()) + 2 * as_index(sighting); }

  Eigen::Vector2d scale_variances_;
  std::vector<std::int64_t> ids_;  // Ids of landmarks and of kept poses
  // Order: pose, landmarks and kept poses, noises of the image's detections; larger than the part in use
  Eigen::MatrixXd P_;
  Eigen::Matrix<double, Eigen::Dynamic, 2> D_;  // Effect of the scale errors on each entry
  Index size_;                                  // Number of entries in use

  // Workspace of the current change.
  std::vector<Term> terms_;
  std::vector<Sight> sights_;
  Eigen::Matrix<double, Eigen::Dynamic, 3> columns_;
};

}  // namespace azimuth
