#pragma once
#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace azimuth {

enum class Verdict {
  ok,
  unknown,  ///< the system does not say, or not to this user
  warning,  ///< works, but worse than it could, or not in every case
  error     ///< does not work
};

constexpr std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::ok:
      return "ok";
    case Verdict::unknown:
      return "unknown";
    case Verdict::warning:
      return "warning";
    case Verdict::error:
      break;
  }
  return "error";
}

/// The outcome of one check.
struct Finding {
  std::string check;  ///< what was looked at, in one word
  Verdict verdict = Verdict::ok;
  std::string what;  ///< what was found, in words
  std::string fix;   ///< the command, or the commands one a line, that mend it; empty when there is nothing to do
};

using Findings = std::vector<Finding>;

inline void append(Findings& all, Findings more) { std::ranges::move(more, std::back_inserter(all)); }

/// The gravest verdict; ok when there is no finding.
Verdict worst(const Findings& findings);

/// For a reader: a line a finding, the commands below it.
std::string text(const Findings& findings);

/// {"verdict": ..., "findings": [{"check", "verdict", "what", "fix"}]}; "fix" is null when there is none.
std::string to_json(const Findings& findings);

}  // namespace azimuth
