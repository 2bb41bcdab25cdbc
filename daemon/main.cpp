#include "daemon/daemon.hpp"
#include "daemon/pipeline/helper_threads.hpp"
#include "settings/configured_estimator.hpp"

namespace azimuth {
namespace {

Helpers threads() {
  return {.make_workers = [](int count) { return std::make_unique<WorkerThreads>(count); },
          .make_task_runner = [] { return std::make_unique<TaskThread>(); }};
}

std::unique_ptr<Estimator> threaded_estimator(const Rig& rig, const Configuration& configuration,
                                              const MapSnapshot* map) {
  return configured_estimator(rig, configuration, map, threads());
}

}  // namespace
}  // namespace azimuth

int main(int argc, char** argv) { return azimuth::run_daemon(argc, argv, azimuth::threaded_estimator); }
