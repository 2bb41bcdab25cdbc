#pragma once
#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "drivers/camera/frame.hpp"
#include "drivers/lcm/lcm_settings.hpp"
#include "drivers/lcm/lcm_sink.hpp"
#include "drivers/lcm/lcm_stamps.hpp"

namespace azimuth {

/// The counters of messages on the frames' channel.
struct LcmFrameCounts {
  std::uint64_t frames = 0;         ///< delivered frames
  std::uint64_t incomplete = 0;     ///< images of which some parts never arrived
  std::uint64_t malformed = 0;      ///< messages that are not valid images
  std::uint64_t unsupported = 0;    ///< images in an unsupported pixel format
  std::uint64_t too_large = 0;      ///< images larger than the reserved memory
  std::uint64_t no_room = 0;        ///< images dropped because all slots were leased
  std::uint64_t other_senders = 0;  ///< messages of senders that are ignored
  std::uint64_t replaced = 0;       ///< frames replaced by a newer one before they were taken
};

/// Images that another process sends, as bot_core's image_t. The images are assembled in the memory that is then
/// leased.
///
/// The sequence numbers count the images of which at least one part arrived, so an image with lost parts shows as a
/// gap. LCM itself does not number images, so an image that was lost completely shows no gap.
///
/// Thread contract: thread-bound; frames may be destroyed on any thread, and later. Allocates only on construction.
class LcmFrames final : public LcmSink {
 public:
  /// Two frames arrive, one waits, one is on its way, one is being processed, and one slot is spare.
  static constexpr unsigned kSlots = 6;
  static constexpr std::size_t kMaxParts = 1024;

  explicit LcmFrames(const LcmSourceSettings& settings);

  void accept(const LcmPacket& packet, LcmPeer sender, const LcmReceipt& receipt) override;
  /// Takes the newest frame if it was not taken yet, and releases the previous contents of `into`. False: there is
  /// none, `into` is unchanged.
  bool take(Frame& into);

  const LcmFrameCounts& counts() const { return counts_; }
  const LcmStampCounts& stamp_counts() const { return stamps_.counts(); }
  std::uint64_t senders() const { return senders_.changes(); }  ///< number of senders used so far

 private:
  /// The memory of the slots.
  struct Pool;
  /// A message that has arrived in part.
  struct Partial {
    bool used = false;
    LcmPeer sender = 0;
    std::uint32_t message = 0, size = 0, bytes = 0;
    std::uint16_t parts = 0;
    std::bitset<kMaxParts> there;
    unsigned slot = 0;
    std::uint64_t sequence = 0;
    LcmReceipt receipt;  // receipt of its first part
  };

  void begin(const LcmPacket& packet, LcmPeer sender, const LcmReceipt& receipt);
  void add(const LcmPacket& packet, Partial& partial);
  void finish(Partial& partial);
  bool hand_on(const Partial& partial);
  void give_up(Partial& partial);
  Partial* find(const LcmPacket& packet, LcmPeer sender);
  Partial& place_for(LcmPeer sender);
  bool claim_slot(unsigned& slot);

  std::string channel_;
  std::size_t slot_bytes_;
  std::shared_ptr<Pool> pool_;
  std::uint32_t free_;  // free slots, one bit each
  LcmSenderChoice senders_;
  LcmStamps stamps_;
  std::array<Partial, 2> partials_;
  std::uint64_t begun_ = 0;
  Frame unread_;
  LcmFrameCounts counts_;
};

}  // namespace azimuth
