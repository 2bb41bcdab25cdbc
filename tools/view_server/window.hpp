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

/// Who may look, and how many at once.
struct WindowSettings {
  std::size_t lookers = 32;
  std::string token = {};               ///< empty: only by this machine's own name
  std::string cookie = "azimuth_view";  ///< that holds the token
};

/// What is behind each path (docs/view.md): pages, and what is live or was recorded.
///
/// Thread contract: thread-bound.
class Window : public HttpHandler {
 public:
  Window(WindowSettings settings, HttpServer::Clock::time_point now) : settings_(std::move(settings)), since_(now) {}

  HttpAnswer answer(const HttpRequest& request) final;

 protected:
  /// What the page asks for, to know which of the two it is: "live" or "recorded".
  virtual std::string_view shows() const = 0;
  /// What is neither the page nor a module; nothing: there is no such thing.
  virtual std::optional<HttpAnswer> answer_own(const HttpRequest& request) = 0;
  virtual std::size_t lookers() const = 0;
  const WindowSettings& settings() const { return settings_; }

 private:
  std::optional<HttpAnswer> refusal(const HttpRequest& request) const;
  HttpAnswer health() const;

  WindowSettings settings_;
  HttpServer::Clock::time_point since_;
};

/// Borrows the view and those who look.
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
  /// `run` is what the page of a replay shows, as JSON.
  RecordedWindow(WindowSettings settings, std::string run, HttpServer::Clock::time_point now)
      : Window(std::move(settings), now), run_(std::make_shared<const std::string>(std::move(run))) {}

 private:
  std::string_view shows() const override { return "recorded"; }
  std::optional<HttpAnswer> answer_own(const HttpRequest& request) override;
  std::size_t lookers() const override { return 0; }

  std::shared_ptr<const std::string> run_;
};

}  // namespace azimuth
