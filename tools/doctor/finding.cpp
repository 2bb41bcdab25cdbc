#include "tools/doctor/finding.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sstream>

namespace azimuth {

Verdict worst(const Findings& findings) {
  const auto gravest = std::ranges::max_element(findings, {}, &Finding::verdict);
  return gravest == findings.end() ? Verdict::ok : gravest->verdict;
}

std::string text(const Findings& findings) {
  std::string out;
  for (const Finding& finding : findings) {
    out += fmt::format("{:<8} {:<11} {}\n", to_string(finding.verdict), finding.check, finding.what);
    std::istringstream commands(finding.fix);
    for (std::string command; std::getline(commands, command);) out += fmt::format("{:21}$ {}\n", "", command);
  }
  return out;
}

std::string to_json(const Findings& findings) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const Finding& finding : findings) {
    list.push_back({{"check", finding.check},
                    {"verdict", to_string(finding.verdict)},
                    {"what", finding.what},
                    {"fix", finding.fix.empty() ? Json(nullptr) : Json(finding.fix)}});
  }
  const Json json{{"verdict", to_string(worst(findings))}, {"findings", std::move(list)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";  // file names need not be valid UTF-8
}

}  // namespace azimuth
