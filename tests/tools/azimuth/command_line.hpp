#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/support/shipped_run.hpp"
#include "tests/support/temporary_folder.hpp"

namespace azimuth::test {

struct Outcome {
  int code = -1;  ///< Exit code; -1: a signal killed the command.
  std::string out, err;
};

/// Runs the azimuth command with these arguments, without a shell.
Outcome azimuth(const std::vector<std::string>& arguments);

/// A temporary folder that gives the paths of its files as arguments of a command line.
class ScratchFolder {
 public:
  std::string operator/(const std::string& name) const { return (folder_ / name).string(); }

 private:
  TemporaryFolder folder_;
};

std::string file_bytes(const std::filesystem::path& file);
void write_file(const std::filesystem::path& file, const std::string& bytes);
/// The content of every file of a folder, keyed by file name.
std::map<std::string, std::string> folder_bytes(const std::filesystem::path& folder);

/// The folder that copy_one_lap() writes. It is made once per process.
std::string one_lap();

/// The digest that a replay of this run prints, or what went wrong.
std::string digest_of(const std::string& run, const std::vector<std::string>& options = {});

}  // namespace azimuth::test
