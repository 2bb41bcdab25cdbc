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

/// Adds estimates of past poses to a filter. The bearings that the filter accepts go into a graph, each with the
/// filter's landmark as its identity. Estimates of the present are exactly those of the filter.
///
/// The graph starts with the drive, since a filter that starts from a map has another frame.
///
/// Thread contract: thread-bound. Allocates memory, since the graph grows.
class WithHindsight final : public Estimator {
 public:
  /// `sigma_scale_distance` is the standard deviation of the scale of all distances, which bearings cannot reveal. The
  /// covariances of past poses include it.
  WithHindsight(std::unique_ptr<Estimator> filter, const Rig& rig, const KnownNamesSettings& settings,
                double sigma_scale_distance);

  bool odometry_begins(bool goes_on) override { return filter_->odometry_begins(goes_on); }
  void predict(const Motion& motion) override;
  void update(const BearingSet& bearings) override;
  /// The filter's estimate; after conclude(), with the landmark positions of the graph.
  void estimate(Estimate& out) const override;
  void look_ahead(const Motion& motion, Estimate& out) const override { filter_->look_ahead(motion, out); }
  void expect(std::vector<ExpectedBearing>& out) const override { filter_->expect(out); }
  std::optional<CameraErrors> camera_errors() const override { return filter_->camera_errors(); }
  RigFinding rig_finding() const override { return filter_->rig_finding(); }
  /// The map that the filter would save. After conclude(), the map has only landmarks that are in the graph, with the
  /// graph's estimates. A map of landmarks with heights is saved as the filter has it.
  bool save_map(MapSnapshot& out) const override;
  bool write_past(std::vector<PastPose>& out) const override;
  bool write_path(std::vector<PathPose>& out) const override;
  /// Rebuilds the graph with the filter's camera calibration, if there is one, and optimises it.
  void conclude() override;

 private:
  /// One image as the filter processed it.
  struct Image {
    BearingSet accepted;                // azimuths in the camera's frame; identities: the filter's landmark ids
    std::vector<Motion> motions;        // since the image before
    std::optional<PoseGaussian> found;  // pose at which a lost robot was relocalised
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
