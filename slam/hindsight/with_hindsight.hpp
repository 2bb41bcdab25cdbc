#pragma once
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "slam/estimator/estimator.hpp"
#include "slam/estimator/lamp_directions.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/hindsight/image_poses.hpp"
#include "slam/hindsight/named_mapper.hpp"

namespace azimuth {

/// A filter that also knows what it has learnt of the past: the bearings it accepts go into a graph, each under the
/// landmark that the filter takes it to be of. What it says of the present is the filter's alone, to the last bit.
///
/// It begins with the drive: a filter that starts from a map has another frame.
///
/// Thread contract: thread-bound. Allocates: the graph grows.
class WithHindsight final : public Estimator {
 public:
  /// All distances may be off by `sigma_scale_distance`, which no bearing tells: what is told of the past has it in it.
  WithHindsight(std::unique_ptr<Estimator> filter, const Rig& rig, const KnownNamesSettings& settings,
                double sigma_scale_distance);

  bool odometry_begins(bool goes_on) override { return filter_->odometry_begins(goes_on); }
  void predict(const Motion& motion) override;
  void update(const BearingSet& bearings) override;
  /// Once concluded, with the landmarks where the graph has them.
  void estimate(Estimate& out) const override;
  void look_ahead(const Motion& motion, Estimate& out) const override { filter_->look_ahead(motion, out); }
  void expect(std::vector<ExpectedBearing>& out) const override { filter_->expect(out); }
  std::optional<CameraErrors> camera_errors() const override { return filter_->camera_errors(); }
  RigFinding rig_finding() const override { return filter_->rig_finding(); }
  /// Once concluded, what the filter would save, of the landmarks that the graph has, where it has them; but a map of
  /// landmarks with heights is saved as the filter has it.
  bool save_map(MapSnapshot& out) const override;
  bool write_past(std::vector<PastPose>& out) const override;
  bool write_path(std::vector<PathPose>& out) const override;
  /// The filter has found out how the camera is mounted: the graph is made anew by that.
  void conclude() override;

 private:
  /// What the filter made of one image.
  struct Image {
    BearingSet accepted;                // azimuths in the camera's frame, identities those of the filter's landmarks
    std::vector<Motion> motions;        // since the one before
    std::optional<PoseGaussian> found;  // where the robot, which had been lost, was found
  };

  void add(const Image& image);
  Bearing in_robot_frame(const Bearing& seen) const;
  void tell_place(LandmarkEstimate& landmark) const;
  const HindsightLandmark* settled(std::int64_t id) const;

  LampDirections directions_;
  double yaw_offset_rad_, camera_height_m_;
  std::unique_ptr<Estimator> filter_;
  KnownNamesSettings settings_;
  double sigma_scale_distance_;
  NamedMapper mapper_;
  ImagePoses image_poses_;
  Eigen::Vector4d camera_errors_ = Eigen::Vector4d::Zero();  // as CameraErrors::mean
  std::vector<Image> images_;
  std::vector<Motion> motions_;  // since the last image
  Estimate said_;
  BearingSet seen_;
  bool follows_camera_ = false, was_lost_ = false, concluded_ = false;
};

}  // namespace azimuth
