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

/// The hidden option that prints description() and ends the program.
inline constexpr const char* kDescribe = "--describe-command-line";

/// Describes `app`, its commands and their options as JSON. Manual pages (packaging/man/) and the shells' completions
/// (completion/) are made from the description. Options without a group are hidden and left out.
///
/// A command is {name, about, footer, options, commands}, an option {names, positional, value, choices, limits,
/// default, required, repeats, about}; `value` is empty for a flag.
std::string description(const CLI::App& app);

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
