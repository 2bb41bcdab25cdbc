#include "tests/support/shipped_run.hpp"

#include <fstream>
#include <string>

#include "tests/support/places.hpp"

namespace azimuth::test {

std::filesystem::path shipped_run() { return source_folder() / "runs/lab"; }

void copy_one_lap(const std::filesystem::path& folder) {
  constexpr double kLap_s = 70.0;
  std::filesystem::create_directories(folder);
  for (const auto& entry : std::filesystem::directory_iterator(shipped_run())) {
    std::ifstream whole(entry.path(), std::ios::binary);
    std::ofstream cut(folder / entry.path().filename(), std::ios::binary);
    bool has_stamps = false;
    for (std::string line; std::getline(whole, line);) {
      if (!has_stamps || std::stod(line) < kLap_s) cut << line << '\n';
      has_stamps = has_stamps || line.starts_with("t_s,");
    }
  }
}

}  // namespace azimuth::test
