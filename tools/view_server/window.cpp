#include "tools/view_server/window.hpp"

#include <array>
#include <fmt/format.h>
#include <utility>

#include "tools/page/html_page.hpp"
#include "tools/view/looker.hpp"
#include "tools/view_server/access.hpp"

namespace azimuth {
namespace {

constexpr std::string_view kPage = "page.html", kModules = "/modules/";

std::string type_of(std::string_view file) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kTypes{
      {{".html", "text/html; charset=utf-8"},
       {".js", "text/javascript; charset=utf-8"},
       {".css", "text/css; charset=utf-8"},
       {".svg", "image/svg+xml"},
       {".json", "application/json"}}};
  for (const auto& [ending, type] : kTypes)
    if (file.ends_with(ending)) return std::string(type);
  return "text/plain; charset=utf-8";
}

std::optional<HttpAnswer> page_file(std::string_view name) {
  for (const PageFile& file : page_files())
    if (file.name == name)
      return HttpAnswer{.type = type_of(name), .body = std::make_shared<const std::string>(file.text)};
  return std::nullopt;
}

HttpAnswer json_answer(std::shared_ptr<const std::string> json) {
  return {.type = "application/json", .body = std::move(json)};
}

class LookerStream final : public HttpStream {
 public:
  LookerStream(LiveView& view, Lookers& lookers) : looker_(view, lookers) {}
  std::size_t read(std::span<char> into) override { return looker_.read(into); }
  bool has_something() const override { return looker_.has_something(); }

 private:
  Looker looker_;
};

}  // namespace

HttpAnswer Window::answer(const HttpRequest& request) {
  if (std::optional<HttpAnswer> refused = refusal(request)) return std::move(*refused);
  const std::string_view path = request.path();
  if (path == "/") {
    std::optional<HttpAnswer> found = page_file(kPage);
    return found ? std::move(*found)
                 : sentence(503, fmt::format("This build carries no page ({} is missing among its files).", kPage));
  }
  if (path == "/health") return health();
  if (std::optional<HttpAnswer> own = answer_own(request)) return std::move(*own);
  if (path.starts_with(kModules))
    if (std::optional<HttpAnswer> file = page_file(path.substr(kModules.size()))) return std::move(*file);
  return sentence(404, "There is nothing here.");
}

/// The answer that denies a request; nothing if access is granted. With a token, any host name is accepted; without
/// one, only local names of this machine. Pages of other sites may only link to the start page.
std::optional<HttpAnswer> Window::refusal(const HttpRequest& request) const {
  const std::string_view site = request.header("Sec-Fetch-Site").value_or("same-origin");
  if (site != "same-origin" && site != "none" && request.path() != "/")
    return sentence(403, "A page of another site may not look in here.");
  if (settings_.token.empty()) {
    if (is_own_name(request.header("Host").value_or("localhost"))) return std::nullopt;
    return sentence(403,
                    "Asked for by a name that is not this machine's own: use http://localhost, or azimuth view "
                    "--listen ADDRESS with its token.");
  }
  if (same_secret(request.cookie(settings_.cookie.c_str()).value_or(""), settings_.token)) return std::nullopt;
  const bool may_enter = request.path() == "/" && same_secret(request.argument("token").value_or(""), settings_.token);
  if (!may_enter)
    return sentence(
        403, "This window needs its token: open the address that azimuth view printed, which ends in ?token=...");
  HttpAnswer enter = sentence(303, "Come in.");
  enter.headers.emplace_back("Location", "/");
  enter.headers.emplace_back(
      "Set-Cookie", fmt::format("{}={}; HttpOnly; SameSite=Strict; Path=/", settings_.cookie, settings_.token));
  return enter;
}

HttpAnswer Window::health() const {
  const double uptime_s = std::chrono::duration<double>(HttpServer::Clock::now() - since_).count();
  return json_answer(std::make_shared<const std::string>(
      fmt::format("{{\"shows\":\"{}\",\"lookers\":{},\"uptime_s\":{:.1f}}}\n", shows(), lookers(), uptime_s)));
}

std::optional<HttpAnswer> LiveWindow::answer_own(const HttpRequest& request) {
  if (request.path() == "/events") return events(request);
  if (request.path() == "/picture") return picture();
  return std::nullopt;
}

HttpAnswer LiveWindow::events(const HttpRequest& request) {
  if (request.is_head()) return {.type = "text/event-stream", .body = nullptr};
  if (lookers_.size() >= settings().lookers)
    return sentence(503, fmt::format("{} look already, which is all there may be: close one of their pages, or start "
                                     "azimuth view with a greater --lookers.",
                                     lookers_.size()));
  return {.type = "text/event-stream", .body = nullptr, .stream = std::make_unique<LookerStream>(view_, lookers_)};
}

HttpAnswer LiveWindow::picture() const {
  const ShownPicture& picture = view_.picture();
  if (!picture.jpeg) return sentence(404, "No picture has come: does the daemon send any (daemon.picture.rate_hz)?");
  return {.type = "image/jpeg", .body = picture.jpeg};
}

std::optional<HttpAnswer> RecordedWindow::answer_own(const HttpRequest& request) {
  if (request.path() != "/run.json") return std::nullopt;
  return json_answer(run_);
}

}  // namespace azimuth
