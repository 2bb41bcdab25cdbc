#pragma once
#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/azimuth/html_output.hpp"
#include "tools/azimuth/replay_run.hpp"
#include "tools/view_server/http_server.hpp"
#include "tools/view_server/window.hpp"

namespace azimuth {

inline constexpr int kViewPort = 8017;

/// Of azimuth view, as the command line gives them.
struct ViewOptions {
  std::vector<std::filesystem::path> recordings;  ///< none: a running daemon is watched
  ReplayOptions replay;                           ///< of each of them; its prefix is the daemon's, too
  HtmlWishes page{.file = {}, .for_window = true};
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  std::string listen;                ///< empty: this machine alone
  std::filesystem::path token_file;  ///< empty: one is made where one is needed
  int port = kViewPort;
  std::size_t lookers = 32;

  bool is_live() const { return recordings.empty(); }
};

void add_view_options(CLI::App& command, ViewOptions& options);

/// Refuses what does not go together.
void check(const CLI::App& command, const ViewOptions& options);

HttpSettings http_settings(const ViewOptions& options);

/// With a token wherever another machine could look. Refuses a file that is none.
WindowSettings window_settings(const ViewOptions& options);

/// To open in a browser.
std::string address_of(const ViewOptions& options, const WindowSettings& window, std::uint16_t port);

}  // namespace azimuth
