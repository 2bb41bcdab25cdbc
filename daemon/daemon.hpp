#pragma once
#include <functional>
#include <memory>

#include "settings/configuration.hpp"
#include "slam/estimator/estimator.hpp"
#include "slam/estimator/rig.hpp"

namespace azimuth {

/// The map is the one to start from; null: from nothing.
using EstimatorFactory =
    std::function<std::unique_ptr<Estimator>(const Rig&, const Configuration&, const MapSnapshot* map)>;

/// The whole of azimuthd but for the choice of the estimator: a main() passes its arguments and a factory.
///
/// Exit codes: 0 the recording ended or a signal stopped it; 1 the system refused something essential; 2 wrong
/// options, configuration or recording, every violation having been printed, or a recording played of which no step
/// came.
int run_daemon(int argc, char** argv, const EstimatorFactory& make_estimator);

}  // namespace azimuth
