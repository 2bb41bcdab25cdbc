// azimuthd with an estimator that hangs for ever at the first bearing with the identity kHangingIdentity.

#include <chrono>
#include <thread>

#include "daemon/daemon.hpp"
#include "tests/daemon/fake_estimator.hpp"
#include "tests/daemon/run_files.hpp"

int main(int argc, char** argv) {
  using azimuth::Bearing;
  using azimuth::BearingSet;
  namespace test = azimuth::test;
  return azimuth::run_daemon(argc, argv,
                             [](const azimuth::Rig&, const azimuth::Configuration&, const azimuth::MapSnapshot*) {
                               return std::make_unique<test::FakeEstimator>([](const BearingSet& set) {
                                 for (const Bearing& bearing : set.bearings) {
                                   while (bearing.identity == test::kHangingIdentity)
                                     std::this_thread::sleep_for(std::chrono::seconds(1));
                                 }
                               });
                             });
}
