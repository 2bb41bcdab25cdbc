#include "settings/command_line/description.hpp"

#include <nlohmann/json.hpp>
#include <vector>

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

}  // namespace

std::string description(const CLI::App& app) { return described(app).dump(1) + '\n'; }

}  // namespace azimuth
