#pragma once
#include <functional>
#include <memory>

#include "settings/configuration.hpp"
#include "slam/estimator/estimator.hpp"
#include "slam/estimator/rig.hpp"

namespace azimuth {

/// Makes the estimator. `map` is the map to start from; null: start without a map.
using EstimatorFactory =
    std::function<std::unique_ptr<Estimator>(const Rig&, const Configuration&, const MapSnapshot* map)>;

/// Runs azimuthd, except for the choice of the estimator: main() passes its arguments and a factory.
///
/// Exit codes: 0: the recording ended or a signal stopped the daemon; 1: the system refused something essential; 2:
/// wrong options, configuration or recording (every error has been printed), or a played recording gave no step.
int run_daemon(int argc, char** argv, const EstimatorFactory& make_estimator);

}  // namespace azimuth
