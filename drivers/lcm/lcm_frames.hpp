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

/// What became of the messages on the frames' channel.
struct LcmFrameCounts {
  std::uint64_t frames = 0;         ///< handed on
  std::uint64_t incomplete = 0;     ///< parts of them never came
  std::uint64_t malformed = 0;      ///< no images, or images that cannot be
  std::uint64_t unsupported = 0;    ///< of a pixel format that nothing here can read
  std::uint64_t too_large = 0;      ///< for the memory set aside
  std::uint64_t no_room = 0;        ///< all of that was leased
  std::uint64_t other_senders = 0;  ///< not listened to
  std::uint64_t replaced = 0;       ///< a newer one came before they were taken
};

/// Images that another process sends: image_t, as of bot_core. Put together in the memory that they are then leased in.
///
/// The sequence numbers of frames count what was begun to arrive: an image of which parts were lost is a gap. LCM
/// itself does not number images, so one of which nothing arrived is no gap.
///
/// Thread contract: thread-bound; frames may die elsewhere, and later. Allocates only to be made.
class LcmFrames final : public LcmSink {
 public:
  static constexpr unsigned kSlots = 6;  ///< two come in, one waits, one is on its way, one is looked at
  static constexpr std::size_t kMaxParts = 1024;

  explicit LcmFrames(const LcmSourceSettings& settings);

  void accept(const LcmPacket& packet, LcmPeer sender, const LcmReceipt& receipt) override;
  /// The newest frame, if it was not taken yet. What `into` held is released first. False: none, `into` unchanged.
  bool take(Frame& into);

  const LcmFrameCounts& counts() const { return counts_; }
  const LcmStampCounts& stamp_counts() const { return stamps_.counts(); }
  std::uint64_t senders() const { return senders_.changes(); }  ///< listened to so far

 private:
  /// The slots' memory.
  struct Pool;
  /// A message that is on its way in.
  struct Partial {
    bool used = false;
    LcmPeer sender = 0;
    std::uint32_t message = 0, size = 0, bytes = 0;
    std::uint16_t parts = 0;
    std::bitset<kMaxParts> there;
    unsigned slot = 0;
    std::uint64_t sequence = 0;
    LcmReceipt receipt;  // of its first part
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
  std::uint32_t free_;  // slots, one bit each
  LcmSenderChoice senders_;
  LcmStamps stamps_;
  std::array<Partial, 2> partials_;
  std::uint64_t begun_ = 0;
  Frame unread_;
  LcmFrameCounts counts_;
};

}  // namespace azimuth
