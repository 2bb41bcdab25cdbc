#pragma once
#include <cassert>
#include <utility>
#include <variant>

#include "settings/violation.hpp"

namespace azimuth {

/// A value, or everything that stood in its way (C++23's std::expected, as far as settings need it).
template <class T>
class [[nodiscard]] Outcome {
 public:
  // Implicit, so that a function returns a value or violations as they are. NOLINTBEGIN(google-explicit-constructor)
  Outcome(T value) : content_(std::move(value)) {}
  Outcome(Violations violations) : content_(std::move(violations)) { assert(!this->violations().empty()); }
  // NOLINTEND(google-explicit-constructor)

  explicit operator bool() const { return content_.index() == 0; }

  /// Only when true.
  const T& value() const& { return std::get<0>(content_); }
  T&& value() && { return std::get<0>(std::move(content_)); }
  const T& operator*() const { return value(); }
  const T* operator->() const { return &value(); }

  /// Only when false.
  const Violations& violations() const { return std::get<1>(content_); }

 private:
  std::variant<T, Violations> content_;
};

}  // namespace azimuth
