#include "tools/compare/words.hpp"

#include <cmath>
#include <fmt/format.h>

namespace azimuth {
namespace {

std::string with_unit(std::string number, const Figure& figure) {
  return figure.unit.empty() ? number : fmt::format("{} {}", number, figure.unit);
}

std::string size_text(const Figure& figure, double change) {
  if (figure.by_ratio) return fmt::format("{:.1f} %", 100.0 * std::abs(change));
  const double shown = figure.shown_factor * std::abs(change);
  return with_unit(fmt::format("{:.{}f}", shown, figure.decimals), figure);
}

}  // namespace

std::string value_text(const Figure& figure, double value) {
  if (!std::isfinite(value)) return "-";
  return with_unit(fmt::format("{:.{}f}", figure.shown_factor * value, figure.decimals), figure);
}

std::string change_text(const Figure& figure, double change) {
  if (std::isnan(change)) return "-";
  return (change < 0.0 ? "-" : "+") + size_text(figure, change);
}

std::string sentence(const Figure& figure, double before, double after, double change, Trend trend) {
  std::string text = fmt::format("{} {}, was {}", figure.label, value_text(figure, after), value_text(figure, before));
  if (trend == Trend::gone) return text + ": no longer measured";
  if (trend != Trend::worse && trend != Trend::better) return text + ": " + std::string(to_string(trend));
  if (std::isnan(change)) return text + ": " + std::string(to_string(trend));
  return fmt::format("{}: {} by {}", text, to_string(trend), size_text(figure, change));
}

std::string counted(std::size_t count, const std::string& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace azimuth
