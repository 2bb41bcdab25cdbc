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

/// The options of azimuth view.
struct ViewOptions {
  std::vector<std::filesystem::path> recordings;  ///< empty: show the running daemon
  ReplayOptions replay;                           ///< options of each recording; its prefix also applies to the daemon
  HtmlWishes page{.file = {}, .for_window = true};
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  std::string listen;                ///< empty: only this machine can open the page
  std::filesystem::path token_file;  ///< empty: a token is made where one is needed
  int port = kViewPort;
  std::size_t lookers = 32;

  bool is_live() const { return recordings.empty(); }
};

void add_view_options(CLI::App& command, ViewOptions& options);

/// Refuses options that contradict each other.
void check(const CLI::App& command, const ViewOptions& options);

HttpSettings http_settings(const ViewOptions& options);

/// The settings of the window, with a token if other machines can open the page. Refuses an invalid token file.
WindowSettings window_settings(const ViewOptions& options);

/// The address to open in a browser.
std::string address_of(const ViewOptions& options, const WindowSettings& window, std::uint16_t port);

}  // namespace azimuth
