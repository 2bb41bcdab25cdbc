#pragma once
#include <azimuth/status_t.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace azimuth {

/// A change, as text for the user.
struct News {
  std::string text;
  std::string_view level;  ///< "info", "warning" or "error"
};

/// Finds the changes between successive status messages. For the first one, reports all noteworthy content.
///
/// Thread contract: thread-bound.
class StatusNews {
 public:
  std::vector<News> take(const status_t& status);
  void clear() { last_.reset(); }

 private:
  std::optional<status_t> last_;
};

}  // namespace azimuth
