#include "tools/replay/timed_estimator.hpp"

#include <utility>

#include "tools/replay/stop_watch.hpp"

namespace azimuth {

TimedEstimator::TimedEstimator(std::unique_ptr<Estimator> estimator, std::vector<double>& update_us)
    : estimator_(std::move(estimator)), update_us_(update_us) {}

void TimedEstimator::update(const BearingSet& observations) {
  const StopWatch watch;
  estimator_->update(observations);
  update_us_.push_back(watch.elapsed_us());
}

}  // namespace azimuth
