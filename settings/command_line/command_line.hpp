#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// The name of a path value in help, manual pages and completions.
template <>
constexpr const char* CLI::detail::type_name<std::filesystem::path>() {
  return "PATH";
}

namespace azimuth {

inline constexpr int kWrongUsage = 2;  ///< exit code

/// The type name of an option that takes one of a few words and checks the word itself. Like CLI::IsMember, it shows
/// the words in help, manual pages and completions.
std::string choices_text(const std::vector<std::string_view>& words);

/// Returns what is wrong with the unexpected words of the command line, one sentence per line, with a suggestion from
/// the options and commands of `app` and of the recognised subcommands. Empty if no word is unexpected.
std::string unexpected_words(const CLI::App& app);

/// Parses the command line into `app`, and then calls `understand`, which may also throw CLI::ParseError. Prints help
/// or version on request, and errors. Returns the exit code to end with, 0 or kWrongUsage, or nothing if the program
/// goes on.
std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv,
                                      const std::function<void()>& understand = {});

}  // namespace azimuth
