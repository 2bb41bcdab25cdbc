// azimuth-sim: a simulated robot to connect to.

#include <cstdio>
#include <exception>

#include "base/visible.hpp"
#include "sim/azimuth_sim/options.hpp"
#include "sim/azimuth_sim/sim_server.hpp"

namespace {

namespace sim = azimuth::sim;

constexpr int kFailed = 1;

int fail(const std::string& message) {
  std::fprintf(stderr, "azimuth-sim: %s\n", azimuth::visible_lines(message).c_str());
  return kFailed;
}

int run(int argc, char** argv) {
  sim::block_stop_signals();
  const sim::ParsedOptions parsed = sim::parse_options(argc, argv);
  if (parsed.exit_code) return *parsed.exit_code;
  azimuth::FileResult<sim::SimDevices> devices =
      sim::open_devices(parsed.options, sim::make_frames(parsed.options.simulation.scenario, parsed.options.images));
  if (!devices) return fail(azimuth::text(devices.error()));
  sim::SimServer server(parsed.options, *std::move(devices));
  if (const auto served = server.run(); !served) return fail(served.error().front().text());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    return fail(error.what());
  }
}
