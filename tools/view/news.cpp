#include "tools/view/news.hpp"

#include <array>
#include <cstdint>
#include <fmt/format.h>

namespace azimuth {
namespace {

struct Topic {
  std::string_view name;
  std::string status_t::*text;
  bool is_trouble;  ///< any text means trouble
};

constexpr std::array<Topic, 9> kTopics{{{"odometer", &status_t::odometer, false},
                                        {"camera", &status_t::camera, false},
                                        {"field log", &status_t::recorder, false},
                                        {"real time", &status_t::realtime, false},
                                        {"images", &status_t::image_trouble, true},
                                        {"input", &status_t::input_trouble, true},
                                        {"map file", &status_t::map_trouble, true},
                                        {"pictures", &status_t::picture_trouble, true},
                                        {"configuration", &status_t::configuration, true}}};

constexpr std::array<std::string_view, 4> kHealths{"starting", "tracking", "degraded", "lost"};
constexpr std::array<std::string_view, 4> kHealthLevels{"info", "info", "warning", "error"};

News health_news(const status_t& status) {
  if (status.health < 0 || status.health > 3) return {"health of another version", "warning"};
  const auto health = static_cast<std::uint8_t>(status.health);
  return {fmt::format("{}{}{}", kHealths.at(health), status.reason.empty() ? "" : ": ", status.reason),
          kHealthLevels.at(health)};
}

}  // namespace

std::vector<News> StatusNews::take(const status_t& status) {
  std::vector<News> news;
  if (!last_ || last_->health != status.health || last_->reason != status.reason) news.push_back(health_news(status));
  for (const Topic& topic : kTopics) {
    const std::string& text = status.*topic.text;
    if (last_ ? (*last_).*topic.text == text : text.empty()) continue;
    if (text.empty())
      news.push_back({fmt::format("{}: {}", topic.name, topic.is_trouble ? "well again" : "none any more"), "info"});
    else
      news.push_back({fmt::format("{}: {}", topic.name, text), topic.is_trouble ? "warning" : "info"});
  }
  last_ = status;
  return news;
}

}  // namespace azimuth
