#pragma once
#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace azimuth {

enum class Verdict {
  ok,
  unknown,  ///< the system does not provide the information, or not to this user
  warning,  ///< works, but not optimally or not in every case
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
  std::string check;  ///< name of the check, one word
  Verdict verdict = Verdict::ok;
  std::string what;  ///< description of the result
  std::string fix;   ///< commands that solve the problem, one per line; empty if nothing needs to be done
};

using Findings = std::vector<Finding>;

inline void append(Findings& all, Findings more) { std::ranges::move(more, std::back_inserter(all)); }

/// The worst verdict; ok if there is no finding.
Verdict worst(const Findings& findings);

/// Text for the user: one line per finding, followed by its commands.
std::string text(const Findings& findings);

/// {"verdict": ..., "findings": [{"check", "verdict", "what", "fix"}]}; "fix" is null if there is none.
std::string to_json(const Findings& findings);

}  // namespace azimuth
