#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sim/azimuth_sim/rendered_frames.hpp"
#include "sim/azimuth_sim/run_files.hpp"
#include "sim/azimuth_sim/simulation.hpp"
#include "sim/pioneer/model.hpp"

namespace azimuth::sim {

/// The command line, checked.
struct Options {
  SimulationSettings simulation;
  std::vector<Fault> faults;  ///< from the start
  double speed = 1.0;
  double duration_s = 0.0;  ///< virtual; 0: no end
  bool end_at_arrival = false;

  std::filesystem::path device;           ///< link to a pseudo-terminal; empty: TCP, or none
  std::optional<std::uint16_t> tcp_port;  ///< 0: one that is free
  std::string can_interface;              ///< empty: the base is on no bus
  std::filesystem::path camera_socket;
  std::optional<ImageSettings> images;  ///< none: bearings only
  std::filesystem::path control_socket;
  RunFileNames files;
  bool quiet = false, verbose = false;
};

struct ParsedOptions {
  Options options;
  std::optional<int> exit_code;  ///< set: end with it, everything has been said
};

ParsedOptions parse_options(int argc, const char* const* argv);

}  // namespace azimuth::sim
