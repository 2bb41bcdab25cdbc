#include <algorithm>
#include <fmt/format.h>

#include "tools/doctor/checks.hpp"
#include "tools/doctor/device_access.hpp"

namespace azimuth {

Finding check_group(const Machine& machine, const std::string& group) {
  const auto id = group_id(machine, group);
  const Account& account = machine.account;
  if (!id) return {"groups", Verdict::unknown, "there is no group " + group + " here", ""};
  if (account.uid == 0) return {"groups", Verdict::ok, "root needs no group " + group, ""};
  if (std::ranges::count(account.groups_here, *id) > 0)
    return {"groups", Verdict::ok, fmt::format("{} is in group {}", account.name, group), ""};
  const bool stale = std::ranges::count(account.groups, *id) > 0;
  return {"groups", Verdict::warning,
          stale ? fmt::format("{} was added to group {} after this session began", account.name, group)
                : fmt::format("{} is not in group {}", account.name, group),
          join_group(machine, *id)};
}

}  // namespace azimuth
