#include "settings/command_line/command_line.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "base/visible.hpp"
#include "settings/suggestion.hpp"

namespace azimuth {
namespace {

using Json = nlohmann::ordered_json;

/// The value of an option. CLI11 writes it as TYPE:CHECK:CHECK, with a choice of words as {a,b}.
struct Value {
  std::string type;
  std::vector<std::string> choices;
  std::string limits;
};

Value value_of(const CLI::Option& option) {
  const std::string all = option.get_type_name();
  const std::size_t end = all.find(':');
  Value value{all.substr(0, end), {}, {}};
  if (end == std::string::npos) return value;
  const std::string check = all.substr(end + 1);
  if (check.starts_with('{') && check.ends_with('}'))
    value.choices = CLI::detail::split(check.substr(1, check.size() - 2), ',');
  else
    value.limits = check;
  return value;
}

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

Json described(const CLI::Option& option) {
  const bool is_flag = option.get_items_expected_max() == 0;
  const Value value = is_flag ? Value{} : value_of(option);
  const std::vector<std::string> names = names_of(option);
  return {{"names", names},
          {"positional", names.empty() ? option.get_name(true) : std::string()},
          {"value", value.type},
          {"choices", value.choices},
          {"limits", value.limits},
          {"default", option.get_default_str()},
          {"required", option.get_required()},
          {"repeats", option.get_expected_max() > 1},
          {"about", option.get_description()}};
}

Json described(const CLI::App& app) {
  Json options = Json::array(), commands = Json::array();
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty()) options.push_back(described(*option));
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    commands.push_back(described(*command));
  return {{"name", app.get_name()},
          {"about", app.get_description()},
          {"footer", app.get_footer()},
          {"options", options},
          {"commands", commands}};
}

/// The name by which the shell calls the command: "azimuth map".
std::string full_name(const CLI::App& app) {
  const CLI::App* const parent = app.get_parent();
  return parent ? full_name(*parent) + ' ' + app.get_name() : app.get_name();
}

/// The names of all visible options, with their dashes. Hidden options have no group.
std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_group().empty()) continue;
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  const std::vector<std::string_view> names(known.begin(), known.end());
  const auto meant = nearest(word, names);
  return meant ? fmt::format("; did you mean '{}'?", *meant) : std::string();
}

std::string unknown_option(const CLI::App& app, std::string_view word) {
  const std::string_view name = word.substr(0, word.find('='));
  return fmt::format("{}: unknown option '{}'{}", full_name(app), visible(name), did_you_mean(name, option_names(app)));
}

std::string unknown_command(const CLI::App& app, std::string_view word, const std::vector<std::string>& commands) {
  const std::string meant = did_you_mean(word, commands);
  return fmt::format("{}: unknown command '{}'{}", full_name(app), visible(word),
                     meant.empty() ? fmt::format("; there are {}", fmt::join(commands, ", ")) : meant);
}

/// Sentences about the words that `app` itself did not expect. Words after an unknown command belong to that command,
/// and a word beside an unknown option is its value; such words get no sentence.
std::vector<std::string> unexpected_by(const CLI::App& app) {
  std::vector<std::string> words, options;
  for (const std::string& word : app.remaining()) (word.starts_with('-') ? options : words).push_back(word);
  const std::vector<std::string> commands = command_names(app);
  if (!words.empty() && !commands.empty() && app.get_subcommands().empty())
    return {unknown_command(app, words.front(), commands)};
  std::vector<std::string> said;
  for (const std::string& option : options) said.push_back(unknown_option(app, option));
  if (said.empty() && !words.empty())
    said.push_back(fmt::format("{}: '{}' is one word too many", full_name(app), visible(words.front())));
  return said;
}

/// Whether the error may come from an unknown word. A mistyped command gives the error that a command is required,
/// which would hide the unknown word.
bool is_about_words(const CLI::ParseError& error) {
  const auto code = static_cast<CLI::ExitCodes>(error.get_exit_code());
  return code == CLI::ExitCodes::ExtrasError || code == CLI::ExitCodes::RequiredError;
}

/// Prints the library's message, which quotes words of the command line.
int say(const CLI::App& app, const CLI::ParseError& error) {
  std::ostringstream out, err;
  const int code = app.exit(error, out, err);
  fmt::print("{}", out.str());
  fmt::print(stderr, "{}", visible_lines(err.str()));
  return code == 0 ? 0 : kWrongUsage;
}

int answer(const CLI::App& app, const CLI::ParseError& error) {
  const std::string words = is_about_words(error) ? unexpected_words(app) : std::string();
  if (words.empty()) return say(app, error);
  fmt::print(stderr, "{}\nRun with --help for more information.\n", words);
  return kWrongUsage;
}

/// Adds the hidden option kDescribe, which is answered before missing arguments are noticed.
void add_describe_option(CLI::App& app) {
  if (app.get_option_no_throw(kDescribe) != nullptr) return;  // the application is parsed again
  const auto describe = [&app] {
    fmt::print("{}", description(app));
    throw CLI::Success();
  };
  app.add_flag_callback(kDescribe, describe)->group("")->trigger_on_parse();
}

}  // namespace

std::string description(const CLI::App& app) { return described(app).dump(1) + '\n'; }

std::string choices_text(const std::vector<std::string_view>& words) {
  return fmt::format("TEXT:{{{}}}", fmt::join(words, ","));
}

std::string unexpected_words(const CLI::App& app) {
  std::vector<std::string> said = unexpected_by(app);
  for (const CLI::App* command : app.get_subcommands())
    if (std::string words = unexpected_words(*command); !words.empty()) said.push_back(std::move(words));
  return fmt::format("{}", fmt::join(said, "\n"));
}

std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv,
                                      const std::function<void()>& understand) {
  add_describe_option(app);
  try {
    app.parse(argc, argv);
    if (understand) understand();
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    return answer(app, error);
  }
}

}  // namespace azimuth
