#pragma once
#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "tools/view/live_view.hpp"
#include "tools/view/lookers.hpp"
#include "tools/view_server/http_server.hpp"

namespace azimuth {

/// Access control of the view.
struct WindowSettings {
  std::size_t lookers = 32;             ///< largest number of simultaneous event streams
  std::string token = {};               ///< empty: access only under a local name of this machine
  std::string cookie = "azimuth_view";  ///< name of the cookie with the token
};

/// Answers requests by path (docs/view.md): page files, and live or recorded data.
///
/// Thread contract: thread-bound.
class Window : public HttpHandler {
 public:
  Window(WindowSettings settings, HttpServer::Clock::time_point now) : settings_(std::move(settings)), since_(now) {}

  HttpAnswer answer(const HttpRequest& request) final;

 protected:
  /// "live" or "recorded", for the page.
  virtual std::string_view shows() const = 0;
  /// Answers paths other than the page and its modules; nothing if the path does not exist.
  virtual std::optional<HttpAnswer> answer_own(const HttpRequest& request) = 0;
  virtual std::size_t lookers() const = 0;
  const WindowSettings& settings() const { return settings_; }

 private:
  std::optional<HttpAnswer> refusal(const HttpRequest& request) const;
  HttpAnswer health() const;

  WindowSettings settings_;
  HttpServer::Clock::time_point since_;
};

/// Serves a live view. Borrows the view and the lookers.
class LiveWindow final : public Window {
 public:
  LiveWindow(WindowSettings settings, LiveView& view, Lookers& lookers, HttpServer::Clock::time_point now)
      : Window(std::move(settings), now), view_(view), lookers_(lookers) {}

 private:
  std::string_view shows() const override { return "live"; }
  std::optional<HttpAnswer> answer_own(const HttpRequest& request) override;
  std::size_t lookers() const override { return lookers_.size(); }
  HttpAnswer events(const HttpRequest& request);
  HttpAnswer picture() const;

  LiveView& view_;
  Lookers& lookers_;
};

class RecordedWindow final : public Window {
 public:
  /// `run`: data of a replay for the page, as JSON.
  RecordedWindow(WindowSettings settings, std::string run, HttpServer::Clock::time_point now)
      : Window(std::move(settings), now), run_(std::make_shared<const std::string>(std::move(run))) {}

 private:
  std::string_view shows() const override { return "recorded"; }
  std::optional<HttpAnswer> answer_own(const HttpRequest& request) override;
  std::size_t lookers() const override { return 0; }

  std::shared_ptr<const std::string> run_;
};

}  // namespace azimuth
