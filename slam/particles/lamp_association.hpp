#pragma once
#include <vector>

#include "slam/association/assignment.hpp"
#include "slam/fastslam/fastslam_settings.hpp"
#include "slam/fastslam/lamp_associator.hpp"

namespace azimuth {

/// Data association of detections with lamps (mathematics II.5): jointly by the best assignment, or each detection with
/// its nearest lamp. A detection with a single possible lamp, for which no other detection competes, is associated
/// directly and left out of the assignment.
///
/// Thread contract: thread-bound; does not allocate once it has grown to the largest image.
class LampAssociation final : public LampAssociator {
 public:
  LampAssociation(LampAssociationMethod method, LampCost cost) : method_(method), cost_(cost) {}
  void associate(const LampPairs& pairs, std::span<int> target_of) override;

 private:
  void take_undisputed(const LampPairs& pairs, std::span<int> target_of);
  void assign(const LampPairs& pairs, std::span<int> target_of);
  void take_nearest(const LampPairs& pairs, std::span<int> target_of);
  double worth(double log_likelihood) const;

  LampAssociationMethod method_;
  LampCost cost_;
  Assignment assignment_;
  std::vector<int> pairs_of_sighting_, pairs_of_target_;
  std::vector<LampPair> disputed_;
  std::vector<int> row_of_sighting_, column_of_target_;  // kUnassigned: not disputed
  std::vector<int> sightings_, targets_;                 // detection of each row and target of each column of table_
  std::vector<double> table_, alone_;
  std::vector<int> column_of_row_;
};

}  // namespace azimuth
