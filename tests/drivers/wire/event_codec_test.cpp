#include "drivers/wire/event_codec.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <iterator>
#include <random>
#include <string>

namespace azimuth {
namespace {

using ::testing::ElementsAre;

using Buffer = std::vector<std::byte>;

Buffer bytes(std::string_view text) {
  const Bytes view = std::as_bytes(std::span(text));
  return {view.begin(), view.end()};
}

std::string text(Bytes data) { return {reinterpret_cast<const char*>(data.data()), data.size()}; }

/// An event whose data contain its number.
Buffer event(std::int64_t number) {
  Buffer out;
  const Buffer data =
      bytes("data of event " + std::to_string(number) + std::string(static_cast<std::size_t>(number) * 3, '.'));
  append_event(out, {number, 1'000'000 + number, "CHANNEL_" + std::to_string(number % 3), data});
  return out;
}

Buffer operator+(Buffer a, const Buffer& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Buffer log_of(std::int64_t events) {
  Buffer log;
  for (std::int64_t i = 0; i < events; ++i) log = log + event(i);
  return log;
}

struct Scan {
  std::vector<std::int64_t> numbers;
  std::uint64_t damaged_bytes = 0;
  std::uint64_t headers_read = 0;
};

Scan scan(Bytes log) {
  EventScanner scanner(log);
  Scan result;
  std::uint64_t whole_bytes = 0;
  while (const auto found = scanner.next()) {
    result.numbers.push_back(found->number);
    whole_bytes += kEventHeaderSize + found->channel.size() + found->data.size();
  }
  result.damaged_bytes = scanner.damaged_bytes();
  result.headers_read = scanner.headers_read();
  EXPECT_EQ(whole_bytes + result.damaged_bytes, log.size()) << "every byte is part of an event or counted";
  return result;
}

TEST(EventCodec, LayoutIsThatOfLcm) {
  Buffer out;
  append_event(out, {0x0102030405060708, -2, "AB", bytes("xyz")});
  EXPECT_EQ(text(out), std::string("\xED\xA1\xDA\x01"
                                   "\x01\x02\x03\x04\x05\x06\x07\x08"
                                   "\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFE"
                                   "\0\0\0\x02\0\0\0\x03"
                                   "ABxyz",
                                   33));
}

TEST(EventScanner, ReturnsWhatWasWritten) {
  const Buffer log = log_of(3);
  EventScanner scanner(log);
  scanner.next();
  const auto second = scanner.next();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->number, 1);
  EXPECT_EQ(second->utime_us, 1'000'001);
  EXPECT_EQ(second->channel, "CHANNEL_1");
  EXPECT_EQ(text(second->data), "data of event 1...");
  EXPECT_THAT(scan(log).numbers, ElementsAre(0, 1, 2));
  EXPECT_EQ(scan(log).damaged_bytes, 0U);
}

TEST(EventScanner, EmptyLogHasNoEvents) { EXPECT_TRUE(scan({}).numbers.empty()); }

TEST(EventScanner, CutAnywhereYieldsAllWholeEvents) {
  const Buffer log = log_of(6);
  std::size_t whole = 0, end_of_whole = 0;
  for (std::size_t cut = 0; cut <= log.size(); ++cut) {
    if (cut == end_of_whole + event(static_cast<std::int64_t>(whole)).size()) end_of_whole = cut, ++whole;
    const Scan result = scan(Bytes(log).first(cut));
    ASSERT_EQ(result.numbers.size(), whole) << "cut at " << cut;
    ASSERT_EQ(result.damaged_bytes, cut - end_of_whole);
  }
}

TEST(EventScanner, BeginningCutAnywhereYieldsAllWholeEvents) {
  const Buffer log = log_of(4);
  for (std::size_t cut = 1; cut <= event(0).size(); ++cut) {
    ASSERT_THAT(scan(Bytes(log).subspan(cut)).numbers, ElementsAre(1, 2, 3)) << "cut at " << cut;
  }
}

TEST(EventScanner, RecordingGoesOnAfterACutEvent) {
  const Buffer cut = event(1);
  for (std::size_t length = 0; length < cut.size(); ++length) {
    const Buffer log =
        event(0) + Buffer(cut.begin(), cut.begin() + static_cast<std::ptrdiff_t>(length)) + event(2) + event(3);
    const Scan result = scan(log);
    ASSERT_THAT(result.numbers, ElementsAre(0, 2, 3)) << "cut at " << length;
    ASSERT_EQ(result.damaged_bytes, length);
  }
}

TEST(EventScanner, ForeignBytesBetweenEventsCostNoEvent) {
  for (const auto& junk : {bytes("junk"), Buffer(4096, std::byte{0}), bytes("\xED\xA1"), bytes("\xED\xED\xA1\xDA")}) {
    const Scan result = scan(junk + event(0) + junk + event(1) + junk);
    EXPECT_THAT(result.numbers, ElementsAre(0, 1));
    EXPECT_EQ(result.damaged_bytes, 3 * junk.size());
  }
}

TEST(EventScanner, WrongLengthsLoseNoOtherEvent) {
  for (std::size_t at = 20; at < kEventHeaderSize; ++at) {
    for (const auto value : {0x00, 0x01, 0x10, 0x7F, 0x80, 0xFF}) {
      Buffer damaged = event(1);
      if (damaged[at] == std::byte(value)) continue;
      damaged[at] = std::byte(value);
      const auto numbers = scan(event(0) + damaged + event(2) + event(3)).numbers;
      EXPECT_EQ(std::ranges::count(numbers, 0), 1);
      EXPECT_EQ(std::ranges::count(numbers, 2), 1) << "length byte " << at << " set to " << value;
      EXPECT_EQ(std::ranges::count(numbers, 3), 1);
    }
  }
}

TEST(EventScanner, LengthsAreBoundedBeforeAnythingElse) {
  Buffer header = event(0);
  header.resize(kEventHeaderSize);
  std::fill(header.begin() + 20, header.end(), std::byte{0xFF});
  EXPECT_THAT(scan(header + event(1)).numbers, ElementsAre(1));
}

TEST(EventScanner, ChangedBytesNeverBreakAccounting) {
  const Buffer whole = log_of(8);
  std::mt19937_64 bits(7);
  for (int round = 0; round < 50'000; ++round) {
    Buffer log = whole;
    for (auto changes = bits() % 8; changes-- > 0;) log[bits() % log.size()] = static_cast<std::byte>(bits());
    if (bits() % 4 == 0) log.resize(bits() % log.size());
    if (bits() % 4 == 0) log.erase(log.begin(), log.begin() + static_cast<std::ptrdiff_t>(bits() % (log.size() + 1)));
    scan(log);
  }
}

/// The header of an event that would extend far over the bytes after it.
Buffer far_reaching_header() {
  Buffer header = event(0);
  header.resize(kEventHeaderSize);
  header[24] = std::byte{0};
  header[25] = std::byte{0x10};
  return header;
}

TEST(EventScanner, WorkIsLinearInHostileLogs) {
  Buffer syncs;  // no sync word is followed by a valid event
  std::uint64_t headers = 0;
  for (; syncs.size() < (std::size_t{4} << 20U); ++headers) {
    std::ranges::copy(far_reaching_header(), std::back_inserter(syncs));
    syncs.push_back(std::byte{'x'});
  }
  const Scan result = scan(syncs);
  EXPECT_GE(result.headers_read, headers);
  EXPECT_LE(result.headers_read, 3 * headers);
}

TEST(EventScanner, WorkIsLinearWhereManyEventsWouldHoldAWholeOne) {
  Buffer log;
  std::uint64_t headers = 0, whole = 0;
  while (log.size() < (std::size_t{4} << 20U)) {
    for (int i = 0; i < 2000; ++i, ++headers) std::ranges::copy(far_reaching_header(), std::back_inserter(log));
    std::ranges::copy(event(1), std::back_inserter(log));
    ++headers, ++whole;
  }
  const Scan result = scan(log);
  EXPECT_GE(result.numbers.size(), whole);
  EXPECT_LE(result.headers_read, 3 * headers);
}

}  // namespace
}  // namespace azimuth
