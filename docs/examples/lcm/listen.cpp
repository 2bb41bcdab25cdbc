// Listens to azimuthd: prints a line for each pose, and one when the health or its reason changes.
//
//   types=/usr/share/azimuth/lcmtypes
//   lcm-gen -x --cpp-std=c++11 $types/pose_cov_t.lcm $types/status_t.lcm
//   g++ -std=c++17 -I. listen.cpp -o listen $(pkg-config --cflags --libs lcm)
//   ./listen

#include <cmath>
#include <cstdio>
#include <lcm/lcm-cpp.hpp>
#include <string>

#include "azimuth/pose_cov_t.hpp"
#include "azimuth/status_t.hpp"

namespace {

class Listener {
 public:
  void pose(const lcm::ReceiveBuffer* /*buffer*/, const std::string& /*channel*/, const azimuth::pose_cov_t* pose) {
    if (pose->predicted) return;  // predicted from odometry between two images
    const double sigma_m = std::sqrt(pose->covariance[0] + pose->covariance[4]);
    std::printf("step %lld  x %.3f y %.3f m  heading %.3f rad  +-%.3f m%s\n", static_cast<long long>(pose->step),
                pose->x_m, pose->y_m, pose->heading_rad, sigma_m,
                pose->health == azimuth::pose_cov_t::HEALTH_LOST ? "  do not steer by it" : "");
    std::fflush(stdout);
  }

  void status(const lcm::ReceiveBuffer* /*buffer*/, const std::string& /*channel*/, const azimuth::status_t* status) {
    if (status->health == health_ && status->reason == reason_) return;
    health_ = status->health;
    reason_ = status->reason;
    std::printf("health %d %s\n", health_, reason_.c_str());
    std::fflush(stdout);
  }

 private:
  int health_ = -1;
  std::string reason_;
};

}  // namespace

int main() {
  lcm::LCM lcm;  // uses LCM_DEFAULT_URL; the default udpm://239.255.76.67:7667?ttl=0 is that of azimuthd
  if (!lcm.good()) return 1;
  Listener listener;
  lcm.subscribe("AZIMUTH_POSE", &Listener::pose, &listener);
  lcm.subscribe("AZIMUTH_STATUS", &Listener::status, &listener);
  std::puts("listening");
  std::fflush(stdout);
  while (lcm.handle() == 0) {
  }
  return 1;
}
