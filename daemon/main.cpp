#include "daemon/daemon.hpp"
#include "slam/estimator/make_estimator.hpp"

int main(int argc, char** argv) { return azimuth::run_daemon(argc, argv, azimuth::make_ekf_estimator); }
