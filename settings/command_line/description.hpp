#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace azimuth {

/// The hidden option that prints description() and ends the program.
inline constexpr const char* kDescribe = "--describe-command-line";

/// Describes `app`, its commands and their options as JSON. Manual pages (packaging/man/) and the shells' completions
/// (completion/) are made from the description. Options without a group are hidden and left out.
///
/// A command is {name, about, footer, options, commands}, an option {names, positional, value, choices, limits,
/// default, required, repeats, about}; `value` is empty for a flag.
std::string description(const CLI::App& app);

}  // namespace azimuth
