#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// What help, manual pages and completions call the value of an option that is a path.
template <>
constexpr const char* CLI::detail::type_name<std::filesystem::path>() {
  return "PATH";
}

namespace azimuth {

inline constexpr int kWrongUsage = 2;  ///< exit code

/// The type name of an option that takes one of a few words and answers another one itself: help, manual pages and
/// completions then know the words, as they do of CLI::IsMember.
std::string choices_text(const std::vector<std::string_view>& words);

/// What is wrong with the words that `app` was given and did not expect, one sentence a line, with what was probably
/// meant: of its options and commands and those of the subcommands that were recognised. Empty: it expected them all.
std::string unexpected_words(const CLI::App& app);

/// Reads the command line into `app`, and then calls `understand`, which may throw CLI::Error as well. What is asked
/// for (help, version) and what is wrong is printed; nothing: neither. Else the exit code to end with: 0 or
/// kWrongUsage.
std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv,
                                      const std::function<void()>& understand = {});

}  // namespace azimuth
