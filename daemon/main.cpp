#include "daemon/daemon.hpp"
#include "settings/configured_estimator.hpp"

int main(int argc, char** argv) { return azimuth::run_daemon(argc, argv, azimuth::configured_estimator); }
