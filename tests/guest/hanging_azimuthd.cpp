// A variant of azimuthd whose estimator hangs for ever in an update if the file in the environment variable
// AZIMUTH_HANG_FILE (default /run/azimuth/hang) exists. It deletes the file first, so that the restarted process does
// not hang again.

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "daemon/daemon.hpp"
#include "settings/configured_estimator.hpp"

namespace azimuth {
namespace {

class HangingEstimator final : public Estimator {
 public:
  HangingEstimator(std::unique_ptr<Estimator> estimator, std::filesystem::path file)
      : estimator_(std::move(estimator)), file_(std::move(file)) {}

  bool odometry_begins(bool goes_on) override { return estimator_->odometry_begins(goes_on); }
  void predict(const Motion& motion) override { estimator_->predict(motion); }
  void update(const BearingSet& observations) override {
    std::error_code error;
    if (std::filesystem::remove(file_, error)) hang();
    estimator_->update(observations);
  }
  void estimate(Estimate& out) const override { estimator_->estimate(out); }
  void look_ahead(const Motion& motion, Estimate& out) const override { estimator_->look_ahead(motion, out); }
  void expect(std::vector<ExpectedBearing>& out) const override { estimator_->expect(out); }
  bool save_map(MapSnapshot& out) const override { return estimator_->save_map(out); }

 private:
  [[noreturn]] static void hang() {
    for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
  }

  std::unique_ptr<Estimator> estimator_;
  std::filesystem::path file_;
};

}  // namespace
}  // namespace azimuth

int main(int argc, char** argv) {
  const char* const named = std::getenv("AZIMUTH_HANG_FILE");
  const std::string file = named ? named : "/run/azimuth/hang";
  return azimuth::run_daemon(
      argc, argv,
      [&](const azimuth::Rig& rig, const azimuth::Configuration& configuration, const azimuth::MapSnapshot* map) {
        return std::make_unique<azimuth::HangingEstimator>(azimuth::configured_estimator(rig, configuration, map),
                                                           file);
      });
}
