#pragma once
// What a particle's pose and map are off by, together (docs/mathematics.md II.11).

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

/// The joint covariance of the errors (estimate less truth) of one particle: e_x of its pose, e_m of each of its
/// landmarks, and what the constant errors of the odometer's scales make of both. A particle's steps have gains of
/// their own, which take the path to be exact where landmarks are concerned; here every error goes through those same
/// gains, with all it has in common with the others, and the noise that the pose is drawn with is added.
///
/// Thread contract: thread-bound. Nothing allocates after construction.
class ErrorCovariance {
 public:
  using Index = Eigen::Index;

  /// `sigma_scales`: what is unknown of the odometer's scales, of distance and of turn.
  ErrorCovariance(std::size_t max_landmarks, std::size_t max_sightings, const Eigen::Vector2d& sigma_scales);

  /// e_x <- G e_x + B e_scales + w
  void predict(const MovedPose& moved);

  /// An image with so many sightings, whose noise the pose and the landmarks will share.
  void begin_image(std::size_t sightings);
  /// The `sighting` moves the pose: of the landmark known as `landmark`, with its covariance as the particle has it.
  void sight(std::size_t sighting, std::int64_t landmark, const LampView& from_x_hat, const Symmetric3& Sigma,
             const Symmetric2& noise);
  /// All of them have: e_x <- e_x + sum K_l (v_l - H_x e_x - H_m e_m) + s, K_l = P H_x^T Q_l^-1 and s drawn from N(0,
  /// P), P the proposal's covariance.
  void draw(const Symmetric3& proposal);
  /// The sighting corrects the landmark from the pose drawn: e_m <- e_m + K (v_l - H_x e_x - H_m e_m). `Sigma` is the
  /// landmark's from before that.
  void learn(std::size_t sighting, std::int64_t landmark, const LampView& from_x_t, const Symmetric3& Sigma,
             const Symmetric2& noise);

  /// Keeps the landmarks that `contains` knows by their ids, and no other.
  template <class Contains>
  void keep_if(const Contains& contains) {
    remove_if([&](std::int64_t id) { return !is_pose(id) && !contains(id); });
  }
  bool has(std::int64_t landmark) const { return index_of(landmark) != kNone; }
  /// The pose as of now, at a `step` after the last one kept, once all sightings of the image are learnt: a landmark
  /// may be mapped from it later. Each costs as much in every image as a landmark does; those of long ago are
  /// forgotten.
  void keep_pose(std::int64_t step);
  bool keeps_pose(std::int64_t step) const { return has(id_of_pose(step)); }
  /// Begins a landmark that was mapped from poses kept: e_m = sum of all mapped_from() + an error of its own.
  void mapped_from(std::int64_t step, const Eigen::Matrix3d& by_pose);
  void add(std::int64_t landmark, const Symmetric3& own);
  /// A landmark as the particle at this pose might just have mapped it: it shares the pose's error, and `own` is its
  /// own.
  void add(std::int64_t landmark, const Pose2& T_map_body, const Eigen::Vector3d& p_map, const Symmetric3& own);

  /// As if the odometer's scales had no error.
  Eigen::Matrix3d pose() const { return P_.topLeftCorner<3, 3>(); }
  /// d(e_x) / d(e_scales): what the scales' errors have made of the pose by now.
  ByScales by_scales() const { return D_.topRows<3>(); }
  const Eigen::Vector2d& scale_variances() const { return scale_variances_; }
  /// Of a landmark there is, with what the scales' errors make of it.
  Eigen::Matrix3d landmark(std::int64_t landmark) const;

  /// Begins with the pose and the landmarks of a map, which is as large as the odometer that made it counted.
  void restore(const MapSnapshot& map);
  /// Of the pose nothing is known that has to do with the map, but that it is off by no more than this; the poses kept
  /// are forgotten.
  void place_pose(const Eigen::Matrix3d& covariance);
  /// Of the pose after `moved` and the landmarks named in `out`, as a map keeps it.
  void save(const MovedPose& moved, MapSnapshot& out) const;

 private:
  static constexpr std::int64_t kMostKept = 48;  // steps
  static constexpr Index kPose = 0, kFirst = 3;
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  /// Part of a linear change: of the entries from `at` on.
  struct Term {
    Index at, size;
    Eigen::Matrix3d by;
  };
  /// A sighting that moves the pose.
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
  // A pose kept is an entry like a landmark, of a number that no landmark has.
  static std::int64_t id_of_pose(std::int64_t step) { return -1 - step; }
  static bool is_pose(std::int64_t id) { return id < 0; }
  static Index entry_of(std::size_t index) { return kFirst + 3 * as_index(index); }
  Index noise_of(std::size_t sighting) const { return entry_of(ids_.size()) + 2 * as_index(sighting); }

  Eigen::Vector2d scale_variances_;
  std::vector<std::int64_t> ids_;  // of landmarks and poses kept
  Eigen::MatrixXd P_;              // pose, landmarks and poses kept, noises of the image's sightings; room for more
  Eigen::Matrix<double, Eigen::Dynamic, 2> D_;  // what the scales' errors make of each
  Index size_;                                  // entries in use

  // Of the running change.
  std::vector<Term> terms_;
  std::vector<Sight> sights_;
  Eigen::Matrix<double, Eigen::Dynamic, 3> columns_;
};

}  // namespace azimuth
