#pragma once
#include <memory>
#include <optional>
#include <utility>

#include "slam/estimator/estimator.hpp"
#include "slam/estimator/rig.hpp"
#include "slam/hindsight/named_mapper.hpp"
#include "slam/hindsight/trail.hpp"

namespace azimuth {

/// A filter that also knows what it has learnt of the past: the bearings it accepts go into a graph, each under the
/// landmark that the filter takes it to be of. What it says of the present is the filter's alone, to the last bit.
///
/// Thread contract: thread-bound. Allocates: the graph grows.
class WithHindsight final : public Estimator {
 public:
  WithHindsight(std::unique_ptr<Estimator> filter, const Rig& rig, const KnownNamesSettings& settings);

  bool odometry_begins(bool goes_on) override { return filter_->odometry_begins(goes_on); }
  void predict(const Motion& motion) override;
  void update(const BearingSet& bearings) override;
  void estimate(Estimate& out) const override { filter_->estimate(out); }
  void look_ahead(const Motion& motion, Estimate& out) const override { filter_->look_ahead(motion, out); }
  void expect(std::vector<ExpectedBearing>& out) const override { filter_->expect(out); }
  bool save_map(MapSnapshot& out) const override { return filter_->save_map(out); }
  bool write_past(std::vector<PastPose>& out) const override;

 private:
  double yaw_offset_rad_;
  std::unique_ptr<Estimator> filter_;
  NamedMapper mapper_;
  Trail trail_;
  Estimate said_;
  BearingSet accepted_;
};

}  // namespace azimuth
