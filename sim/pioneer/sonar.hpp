#pragma once
// The sonar's effect on the line: readings that take up room in SIPs. There are never any echoes.

#include <vector>

#include "sim/pioneer/model.hpp"
#include "sim/pioneer/packets.hpp"

namespace azimuth::sim {

/// Thread contract: thread-bound.
class Sonar {
 public:
  explicit Sonar(const PioneerModel& model) : model_(model) {}

  void switch_on(bool on) { on_ = on; }
  bool on() const { return on_; }
  /// The new readings of one SIP cycle: those whose turn it is, or all.
  std::vector<SonarReading> ping(bool all);

 private:
  PioneerModel model_;
  bool on_ = false;
  int next_ = 0;
};

}  // namespace azimuth::sim
