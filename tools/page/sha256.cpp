#include "tools/page/sha256.hpp"

#include <glib.h>
#include <memory>

namespace azimuth {

std::array<std::byte, 32> sha256(std::string_view text) {
  const std::unique_ptr<GChecksum, decltype(&g_checksum_free)> checksum(g_checksum_new(G_CHECKSUM_SHA256),
                                                                        &g_checksum_free);
  g_checksum_update(checksum.get(), reinterpret_cast<const guchar*>(text.data()), static_cast<gssize>(text.size()));
  std::array<std::byte, 32> digest{};
  gsize size = digest.size();
  g_checksum_get_digest(checksum.get(), reinterpret_cast<guint8*>(digest.data()), &size);
  return digest;
}

}  // namespace azimuth
