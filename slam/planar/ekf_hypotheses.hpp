#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "slam/estimator/restartable_estimator.hpp"
#include "slam/planar/ekf_estimator.hpp"

namespace azimuth {

/// Multi-hypothesis EKF for the first metres of a drive whose bearings have no names. Poses and landmarks are uncertain
/// then, and a wrong association stays in the map, so the decision is delayed: the most likely joint association
/// hypotheses of an image are followed in parallel, each by its own filter, and ranked by the likelihood of all images
/// so far. After kUndecided_m of driving only the most likely filter continues.
///
/// Until then the pose is that of the most likely filter. Its covariance includes the other filters' poses, weighted by
/// likelihood. Images taken while the robot stands still do not create hypotheses, since they cannot tell them apart.
///
/// Thread contract: thread-bound. No call allocates once only one filter is left and its map has stopped growing.
class EkfHypotheses final : public RestartableEstimator {
 public:
  static constexpr double kUndecided_m = 5.0;  ///< Distance driven

  /// Follows up to `most` hypotheses at once; at least 1.
  EkfHypotheses(std::unique_ptr<EkfEstimator> first, int most);

  bool odometry_begins(bool goes_on) override { return best().odometry_begins(goes_on); }
  void predict(const Motion& motion) override;
  void update(const BearingSet& bearings) override;
  void estimate(Estimate& out) const override;
  void look_ahead(const Motion& motion, Estimate& out) const override;
  void expect(std::vector<ExpectedBearing>& out) const override { best().expect(out); }
  bool save_map(MapSnapshot& out) const override { return best().save_map(out); }

  std::optional<CameraErrors> camera_errors() const override { return best().camera_errors(); }
  RigFinding rig_finding() const override { return best().rig_finding(); }
  bool searching() const override { return best().searching(); }
  AssociationCounts counts() const override;
  std::int64_t next_id() const override { return best().next_id(); }
  std::int64_t ids_skipped() const override { return branches_.front().ids_skipped; }

  const EkfEstimator& best() const { return *branches_.front().filter; }
  std::size_t size() const { return branches_.size(); }

 private:
  struct Branch {
    std::unique_ptr<EkfEstimator> filter;
    double log_likelihood = 0.0;  ///< Likelihood of all images, relative to the most likely branch
    std::int64_t ids_skipped = 0;
  };
  struct Choice {
    std::size_t branch, hypothesis;
    double log_likelihood;
  };
  EkfEstimator& best() { return *branches_.front().filter; }
  void choose(const BearingSet& bearings);
  void follow(const BearingSet& bearings);
  void count_on();
  template <typename Write>
  void widen(Estimate& out, const Write& write) const;

  std::size_t most_;
  std::vector<Branch> branches_, next_;  // most likely first
  std::vector<Choice> choices_;
  double path_m_ = 0.0;
  bool moved_ = true;                  // the robot moved since the last image
  AssociationCounts counted_, ahead_;  // counts published last, and how far the best filter's own counts are below them
};

}  // namespace azimuth
