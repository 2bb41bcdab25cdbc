#include "tools/azimuth/view_options.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <string_view>
#include <sys/stat.h>

#include "base/file_result.hpp"
#include "drivers/lcm/lcm_address.hpp"
#include "settings/file_text.hpp"
#include "tools/azimuth/command.hpp"
#include "tools/view_server/access.hpp"
#include "tools/view_server/listening_socket.hpp"

namespace azimuth {
namespace {

constexpr std::size_t kMostRecordings = 2;

bool is_for_others(const ViewOptions& options) { return !options.listen.empty() && !is_loopback(options.listen); }

std::string token_in(const std::filesystem::path& file) {
  FileResult<std::string> text = file_text(file);
  if (!text) refuse(text.error());
  std::string token = *std::move(text);
  while (token.ends_with('\n') || token.ends_with('\r') || token.ends_with(' ')) token.pop_back();
  if (const auto why = why_no_token(token)) refuse(file.string() + ": " + *why);
  struct stat status {};
  if (::stat(file.c_str(), &status) == 0 && (status.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    refuse(file.string() + ": others may read this token: chmod 600 " + file.string());
  return token;
}

/// Refuses options that do not apply to the kind of window, live or recorded.
void refuse_options_without_effect(const CLI::App& command, bool is_live) {
  constexpr std::array<std::string_view, 5> kOfBoth{"--help", "--port", "--listen", "--token-file", "--prefix"};
  constexpr std::array<std::string_view, 2> kOfLive{"--lcm-url", "--lookers"};
  for (const CLI::Option* const option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || option->get_positional() || std::ranges::count(kOfBoth, name) > 0) continue;
    const bool is_of_live = std::ranges::count(kOfLive, name) > 0;
    if (is_of_live != is_live)
      refuse(fmt::format("azimuth view: {} has no effect on {}", name,
                         is_live ? "the running daemon: it says how a recording is shown" : "a recording"));
  }
}

}  // namespace

void add_view_options(CLI::App& command, ViewOptions& options) {
  command.add_option("RUN", options.recordings,
                     "Run folder, LCM log, session folder of a daemon or map file (.azmap) to show; two are shown over "
                     "each other; none: the running daemon");
  command.add_option("--lcm-url", options.lcm_url, "LCM address to which azimuthd sends (its daemon.lcm.url)")
      ->capture_default_str();
  command.add_option("--port", options.port, "Port to listen on; 0: any free port, which is printed")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command.add_option("--listen", options.listen,
                     "Address of this machine to listen on, in numbers, so that other machines can open the page with "
                     "the token that is printed. Without it only this machine can open the page");
  command.add_option("--token-file", options.token_file,
                     "File with the token that a viewer needs, readable for its owner alone; without it a token is "
                     "made up where --listen needs one");
  command.add_option("--lookers", options.lookers, "Most pages that show a running daemon at once")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command.add_option("--pictures", options.page.pictures, "Most images of each recording; 0: none")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  add_run_options(command, options.replay);
}

void check(const CLI::App& command, const ViewOptions& options) {
  refuse_options_without_effect(command, options.is_live());
  if (options.recordings.size() > kMostRecordings)
    refuse(
        fmt::format("azimuth view: {} recordings; two at most are shown over each other", options.recordings.size()));
  if (!options.listen.empty() && !is_address(options.listen))
    refuse("--listen " + options.listen +
           ": must be an address of this machine in numbers, such as 192.168.1.7; `ip address` lists them");
  if (options.is_live() && !parse_lcm_url(options.lcm_url))
    refuse("--lcm-url " + options.lcm_url +
           ": must be of a multicast group, such as udpm://239.255.76.67:7667?ttl=0; a log file is given as it is: "
           "azimuth view LOG");
}

HttpSettings http_settings(const ViewOptions& options) {
  HttpSettings settings;
  if (!options.listen.empty()) settings.address = options.listen;
  settings.port = static_cast<std::uint16_t>(options.port);
  return settings;
}

WindowSettings window_settings(const ViewOptions& options) {
  WindowSettings settings{.lookers = options.lookers, .token = {}};
  if (!options.token_file.empty())
    settings.token = token_in(options.token_file);
  else if (is_for_others(options))
    settings.token = random_token();
  // Cookies are shared by all ports of a machine, so each window has a cookie name of its own.
  settings.cookie = fmt::format("azimuth_view_{}", options.port);
  return settings;
}

std::string address_of(const ViewOptions& options, const WindowSettings& window, std::uint16_t port) {
  std::string host = options.listen.empty() ? "localhost" : options.listen;
  if (host.find(':') != std::string::npos) host = '[' + host + ']';
  return fmt::format("http://{}:{}/{}{}", host, port, window.token.empty() ? "" : "?token=", window.token);
}

}  // namespace azimuth
