#include "tools/page/base64.hpp"

#include <glib.h>
#include <memory>

namespace azimuth {

std::string base64(std::span<const std::byte> bytes) {
  const std::unique_ptr<gchar, decltype(&g_free)> text(
      g_base64_encode(reinterpret_cast<const guchar*>(bytes.data()), bytes.size()), &g_free);
  return text.get();
}

}  // namespace azimuth
