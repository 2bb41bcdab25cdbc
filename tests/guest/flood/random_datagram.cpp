#include "tests/guest/flood/random_datagram.hpp"

#include <algorithm>
#include <azimuth/bearings_t.hpp>
#include <azimuth/features_t.hpp>
#include <azimuth/image_t.hpp>
#include <azimuth/map_chunk_t.hpp>
#include <azimuth/odometry_t.hpp>
#include <azimuth/pose_cov_t.hpp>
#include <azimuth/pose_t.hpp>
#include <string_view>

namespace azimuth::guest {
namespace {

constexpr std::size_t kMostNoiseBytes = 4096;

template <class Message>
Octets encoded(const Message& message) {
  Octets octets(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(octets.data(), 0, static_cast<int>(octets.size()));
  return octets;
}

image_t small_image() {
  image_t image{};
  image.width = image.height = image.row_stride = 8;
  image.pixelformat = image_t::PIXEL_FORMAT_GRAY;
  image.data.assign(64, 100);
  image.size = 64;
  return image;
}

bearings_t few_bearings() {
  bearings_t bearings{};
  bearings.bearings.resize(3);
  bearings.n = 3;
  return bearings;
}

void put_noise(Octets& into, std::size_t bytes, std::mt19937_64& random) {
  for (std::size_t i = 0; i < bytes; ++i) into.push_back(static_cast<std::uint8_t>(random()));
}

void put_big(Octets& into, std::uint64_t number, unsigned bytes) {
  while (bytes-- > 0) into.push_back(static_cast<std::uint8_t>(number >> (8 * bytes)));
}

/// A random size with a random number of bits. Small sizes are frequent, because a subscriber accepts them more often.
std::uint64_t any_size(std::mt19937_64& random) {
  const std::uint64_t bits = random() % 33;
  return random() & ((std::uint64_t{1} << bits) - 1);
}

/// Header of a fragment: sequence, size of the message, offset, fragment number, number of fragments.
void put_piece_header(Octets& into, std::mt19937_64& random) {
  put_big(into, random() % 16, 4);
  put_big(into, any_size(random), 4);
  put_big(into, any_size(random), 4);
  put_big(into, random() % 2 == 0 ? 0 : any_size(random), 2);
  put_big(into, any_size(random), 2);
}

}  // namespace

RandomMessages::RandomMessages(std::uint64_t seed)
    : random_(seed), sound_{encoded(small_image()), encoded(odometry_t{}),  encoded(few_bearings()),
                            encoded(features_t{}),  encoded(map_chunk_t{}), encoded(pose_t{}),
                            encoded(pose_cov_t{})} {}

const Octets& RandomMessages::next() {
  message_.clear();
  if (random_() % 4 == 0) {
    put_noise(message_, random_() % kMostNoiseBytes, random_);
  } else {
    message_ = sound_[random_() % sound_.size()];
    damage();
  }
  return message_;
}

/// Mostly keeps the fingerprint, so that the subscriber decodes the rest.
void RandomMessages::damage() {
  constexpr std::size_t kFingerprintBytes = 8;
  const std::size_t from = random_() % 8 == 0 ? 0 : kFingerprintBytes;
  switch (random_() % 4) {
    case 0:
      message_.resize(random_() % message_.size());
      return;
    case 1:
      put_noise(message_, 1 + random_() % 64, random_);
      return;
    default:
      for (std::uint64_t changes = 1 + random_() % 16; changes > 0; --changes) {
        message_[from + random_() % (message_.size() - from)] = static_cast<std::uint8_t>(random_());
      }
  }
}

void random_datagram(const std::string& channel, std::mt19937_64& random, Octets& into) {
  constexpr std::string_view kMagics[] = {"LC02", "LC03", "LC01"};
  into.clear();
  const std::uint64_t kind = random() % 4;
  if (kind < 3) {
    const std::string_view magic = kMagics[kind];
    into.assign(magic.begin(), magic.end());
    if (magic == "LC03") {
      put_piece_header(into, random);
    } else {
      put_big(into, random(), 4);
    }
    if (random() % 4 != 0) into.insert(into.end(), channel.begin(), channel.end());
    if (random() % 4 != 0) into.push_back(0);
  }
  put_noise(into, random() % (kMostDatagramBytes / 2), random);
  if (random() % 8 == 0) into.resize(random() % 24);
  into.resize(std::min(into.size(), kMostDatagramBytes));
}

}  // namespace azimuth::guest
