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

/// The validated options of the command line.
struct Options {
  SimulationSettings simulation;
  std::vector<Fault> faults;  ///< Faults that are active from the start
  double speed = 1.0;
  double duration_s = 0.0;  ///< Duration of the simulation in virtual time; 0: unlimited
  bool end_at_arrival = false;

  std::filesystem::path device;           ///< Link to a pseudo-terminal; empty: TCP or no serial line
  std::optional<std::uint16_t> tcp_port;  ///< 0: any free port
  std::string can_interface;              ///< Empty: the base is on no CAN bus
  std::filesystem::path camera_socket;
  std::optional<ImageSettings> images;  ///< nullopt: bearings only
  std::filesystem::path control_socket;
  RunFileNames files;
  bool quiet = false, verbose = false;
};

struct ParsedOptions {
  Options options;
  std::optional<int> exit_code;  ///< If set, the program must end with this code; all messages have been printed
};

ParsedOptions parse_options(int argc, const char* const* argv);

}  // namespace azimuth::sim
