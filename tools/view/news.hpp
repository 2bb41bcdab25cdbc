#pragma once
#include <azimuth/status_t.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace azimuth {

/// Something that changed, for a person.
struct News {
  std::string text;
  std::string_view level;  ///< "info", "warning" or "error"
};

/// What one status says that the one before did not; of the first one all that is worth a word.
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
