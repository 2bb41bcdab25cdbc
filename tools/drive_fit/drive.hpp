#pragma once
// A recorded drive as what there is to fit: odometry as it came, and bearings of landmarks that are told apart.

#include <cstddef>
#include <memory>
#include <vector>

#include "slam/estimator/estimator.hpp"
#include "slam/estimator/estimator_stage.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

struct Drive {
  std::vector<OdometryReading> odometry;  ///< raw
  std::vector<BearingSet> sets;           ///< those that had odometry; azimuths in the camera's frame

  bool names_are_landmarks = true;  ///< those of a survey; false: names are given here, as things come

  std::size_t named_bearings() const;
};

/// For a drive that is to be heard: live, a bearing cannot wait long for its odometry; of a recording all is there, and
/// a lag or a slow odometer is what is to be found out.
StageSettings with_patience(StageSettings stage);

/// Stands where an estimator would, and writes down what reaches it: what the stage took of a run, with the rig's clock
/// and hand. With a `filter`, bearings are those that it accepts, each under the landmark that it takes it to be of.
///
/// Borrows `drive`. Thread contract: thread-bound. Allocates.
class DriveListener final : public Estimator {
 public:
  explicit DriveListener(Drive& drive, std::unique_ptr<Estimator> filter = nullptr);

  void predict(const Motion& motion) override;
  void update(const BearingSet& set) override;
  void estimate(Estimate& out) const override;
  void look_ahead(const Motion& motion, Estimate& out) const override;

 private:
  Drive& drive_;
  std::unique_ptr<Estimator> filter_;
  Estimate said_;
};

}  // namespace azimuth
