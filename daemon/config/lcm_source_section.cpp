#include "daemon/config/lcm_source_section.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "drivers/lcm/lcm_address.hpp"
#include "drivers/wire/channels.hpp"
#include "drivers/wire/event_codec.hpp"

namespace azimuth {
namespace {

bool is_own_channel(const std::string& name, const PublishSettings& publish) {
  std::vector<std::string_view> own{channel::kPose,   channel::kBotPose, channel::kMapChunk, channel::kPath,
                                    channel::kStatus, channel::kPicture, channel::kKept};
  if (publish.echo_samples)
    own.insert(own.end(), {channel::kOdometry, channel::kBearings, channel::kFeatures, channel::kSightings,
                           channel::kExpected, channel::kDocument});
  return std::ranges::any_of(own,
                             [&](std::string_view each) { return name == publish.channel_prefix + std::string(each); });
}

}  // namespace

Section lcm_source_section(LcmSourceSettings& source) {
  return {"daemon.lcm_source",
          "Samples that another process sends over LCM, for daemon.live. The daemon believes everyone who can send to "
          "the group: for trusted networks only.",
          {{"url", &source.url, "Multicast group to listen to, udpm://GROUP:PORT."},
           {"frames_channel", &source.frames_channel, "Channel of images: image_t, as of bot_core."},
           {"odometry_channel", &source.odometry_channel,
            "Channel of odometry: odometry_t, or pose_t as of bot_core, in any frame that does not jump."},
           choice<LcmStampKind>(
               "stamps", source.stamps, {{"sender", LcmStampKind::sender}, {"receipt", LcmStampKind::receipt}},
               "Stamps of the samples. sender: the stamps in the messages, by this machine's clock; receipt: the time "
               "of arrival, for senders with another clock, or for a log that is played.")}};
}

FileErrors check(const LcmSourceSettings& source, const PublishSettings& publish) {
  FileErrors violations;
  const std::string section = "daemon.lcm_source.";
  const auto address = parse_lcm_url(source.url);
  if (!address)
    violations.push_back(
        {section + "url", 0, "is \"" + source.url + "\", must be udpm://GROUP:PORT, a multicast group"});
  const bool hears_itself = address && parse_lcm_url(publish.lcm_url) == address;
  const auto check_channel = [&](const char* key, const std::string& name) {
    if (name.empty() || name.size() > kMaxChannelLength)
      violations.push_back({section + key, 0, "must have 1 to " + std::to_string(kMaxChannelLength) + " characters"});
    if (hears_itself && is_own_channel(name, publish))
      violations.push_back({section + key, 0, "is \"" + name + "\", which the daemon itself sends on"});
  };
  check_channel("frames_channel", source.frames_channel);
  check_channel("odometry_channel", source.odometry_channel);
  if (source.frames_channel == source.odometry_channel)
    violations.push_back({section + "odometry_channel", 0, "is that of the frames"});
  return violations;
}

}  // namespace azimuth
