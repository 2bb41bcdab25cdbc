#include "settings/violation.hpp"

#include <fmt/format.h>

namespace azimuth {

std::string Violation::text() const {
  if (line == 0) return fmt::format("{}: {}", file, message);
  if (column == 0) return fmt::format("{}:{}: {}", file, line, message);
  return fmt::format("{}:{}:{}: {}", file, line, column, message);
}

std::string text(const Violations& violations) {
  std::string lines;
  for (const Violation& violation : violations) lines += violation.text() + '\n';
  return lines;
}

}  // namespace azimuth
