#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "slam/estimator/begins_twice.hpp"
#include "slam/planar/ekf_estimator.hpp"

namespace azimuth {

/// The first metres of an EKF whose bearings have no names. What a bearing is of is decided from poses and landmarks
/// that are vague then, and a wrong decision stays in the map, so it is put off: the likeliest joint hypotheses of an
/// image are followed side by side, each by a filter of its own, and ranked by the likelihood of all images so far.
/// After kUndecided_m the likeliest one goes on alone.
///
/// Until then the pose is that of the likeliest one, with a covariance that has the others' poses in it as far as they
/// are likely. A robot that stands still learns nothing that could tell them apart.
///
/// Thread contract: thread-bound. No call allocates once one goes on alone and its map has stopped growing.
class EkfHypotheses final : public BeginsTwice {
 public:
  static constexpr double kUndecided_m = 5.0;  ///< driven

  /// Follows `most` at once, at least 1.
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
    double log_likelihood = 0.0;  ///< of all images, from that of the likeliest
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
  std::vector<Branch> branches_, next_;  // the likeliest first
  std::vector<Choice> choices_;
  double path_m_ = 0.0;
  bool moved_ = true;                  // since the last image
  AssociationCounts counted_, ahead_;  // published last; by how much the likeliest filter's own are short of that
};

}  // namespace azimuth
