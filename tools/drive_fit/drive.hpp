#pragma once
// A recorded drive as input of a fit: raw odometry, and bearings with data association.

#include <cstddef>
#include <memory>
#include <vector>

#include "slam/estimator/estimator.hpp"
#include "slam/estimator/estimator_stage.hpp"
#include "slam/sample/bearings.hpp"
#include "slam/sample/odometry.hpp"

namespace azimuth {

struct Drive {
  std::vector<OdometryReading> odometry;  ///< uncalibrated readings
  std::vector<BearingSet> sets;           ///< bearing sets covered by odometry; azimuths in the camera's frame

  bool names_are_landmarks = true;  ///< identities are those of a survey; false: given by tracking

  std::size_t named_bearings() const;
};

/// Stage settings for a recording, in which bearings wait longer for odometry than in live operation. Nothing is lost
/// by waiting, and the fit has to cope with a lag or with slow odometry.
StageSettings with_patience(StageSettings stage);

/// Takes the place of the estimator and records the bearing sets that reach it, after the stage has applied the rig's
/// clock and azimuth direction. If there is a `filter`, the recorded bearings are those that the filter accepts, with
/// the identity of the landmark to which the filter assigns them.
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
