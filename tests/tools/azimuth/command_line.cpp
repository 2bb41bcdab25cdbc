#include "tests/tools/azimuth/command_line.hpp"

#include <fcntl.h>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/shipped_run.hpp"

namespace azimuth::test {
namespace {

/// The output goes to a file because a pipe that nobody reads would block the command.
void redirect(posix_spawn_file_actions_t& actions, int descriptor, const std::string& file) {
  posix_spawn_file_actions_addopen(&actions, descriptor, file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
}

}  // namespace

std::string one_lap() {
  static const ScratchFolder scratch;
  const std::string lap = scratch / "lab";
  if (!std::filesystem::exists(lap)) copy_one_lap(lap);
  return lap;
}

Outcome azimuth(const std::vector<std::string>& arguments) {
  const ScratchFolder scratch;
  const std::string out = scratch / "out", err = scratch / "err";
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  redirect(actions, STDOUT_FILENO, out);
  redirect(actions, STDERR_FILENO, err);

  std::vector<std::string> words{AZIMUTH_COMMAND};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t child = 0;
  const int refused = posix_spawn(&child, AZIMUTH_COMMAND, &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  Outcome outcome;
  int status = 0;
  if (refused != 0 || waitpid(child, &status, 0) != child) return outcome;
  if (WIFEXITED(status)) outcome.code = WEXITSTATUS(status);
  outcome.out = file_bytes(out);
  outcome.err = file_bytes(err);
  return outcome;
}

std::string file_bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void write_file(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

std::map<std::string, std::string> folder_bytes(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    files[entry.path().filename().string()] = file_bytes(entry.path());
  return files;
}

std::string digest_of(const std::string& run, const std::vector<std::string>& options) {
  std::vector<std::string> arguments{"replay", run};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Outcome outcome = azimuth(arguments);
  const std::size_t at = outcome.out.rfind("digest");
  if (outcome.code != 0 || at == std::string::npos) return "no digest: " + outcome.err;
  return outcome.out.substr(outcome.out.find_first_not_of(' ', at + 6), 16);
}

}  // namespace azimuth::test
