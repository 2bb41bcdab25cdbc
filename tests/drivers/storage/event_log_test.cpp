// Azimuth's log files with liblcm's own reader and writer, and errors of the file.

#include "drivers/storage/event_log.hpp"

#include <gmock/gmock.h>
#include <lcm/eventlog.h>
#include <memory>

#include "tests/drivers/storage/samples.hpp"
#include "tests/support/data.hpp"

namespace azimuth {
namespace {

Bytes bytes_of(std::string_view text_of) { return std::as_bytes(std::span(text_of)); }
std::string text_of(Bytes data) { return {reinterpret_cast<const char*>(data.data()), data.size()}; }

struct LcmLog {
  LcmLog(const std::filesystem::path& file, const char* mode) : log(lcm_eventlog_create(file.c_str(), mode)) {}
  LcmLog(const LcmLog&) = delete;
  LcmLog& operator=(const LcmLog&) = delete;
  ~LcmLog() { lcm_eventlog_destroy(log); }
  lcm_eventlog_t* log;
};

EventLogReader open(const std::filesystem::path& file) {
  auto reader = EventLogReader::open(file);
  if (!reader) throw std::runtime_error(azimuth::text(reader.error()));
  return *std::move(reader);
}

TEST(EventLog, LiblcmReadsWhatWeWrite) {
  const test::TemporaryFolder folder;
  {
    auto writer = EventLogWriter::create(folder / "ours.lcm");
    ASSERT_TRUE(writer);
    for (int i = 0; i < 1000; ++i) {
      ASSERT_FALSE(writer->write(1'700'000'000'000'000 + i, "CHANNEL", bytes_of("data " + std::to_string(i))));
    }
  }
  const LcmLog log(folder / "ours.lcm", "r");
  for (int i = 0; i < 1000; ++i) {
    const std::unique_ptr<lcm_eventlog_event_t, void (*)(lcm_eventlog_event_t*)> event(
        lcm_eventlog_read_next_event(log.log), lcm_eventlog_free_event);
    ASSERT_TRUE(event);
    EXPECT_EQ(event->eventnum, i);
    EXPECT_EQ(event->timestamp, 1'700'000'000'000'000 + i);
    EXPECT_STREQ(event->channel, "CHANNEL");
    EXPECT_EQ(std::string(static_cast<const char*>(event->data), static_cast<std::size_t>(event->datalen)),
              "data " + std::to_string(i));
  }
  EXPECT_EQ(lcm_eventlog_read_next_event(log.log), nullptr);
}

TEST(EventLog, ReadsWhatLiblcmWrites) {
  const test::TemporaryFolder folder;
  {
    const LcmLog log(folder / "theirs.lcm", "w");
    std::string channel = "SOME_CHANNEL", data = "payload";
    lcm_eventlog_event_t event{.eventnum = 0,
                               .timestamp = 42,
                               .channellen = static_cast<std::int32_t>(channel.size()),
                               .datalen = static_cast<std::int32_t>(data.size()),
                               .channel = channel.data(),
                               .data = data.data()};
    for (int i = 0; i < 10; ++i) ASSERT_EQ(lcm_eventlog_write_event(log.log, &event), 0);
  }
  EventLogReader reader = open(folder / "theirs.lcm");
  for (int i = 0; i < 10; ++i) {
    const auto event = reader.next();
    ASSERT_TRUE(event);
    EXPECT_EQ(event->number, i);
    EXPECT_EQ(event->utime_us, 42);
    EXPECT_EQ(event->channel, "SOME_CHANNEL");
    EXPECT_EQ(text_of(event->data), "payload");
  }
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.damaged_bytes(), 0U);
}

TEST(EventLog, ReadsALogOfAnotherProgram) {
  AZIMUTH_REQUIRE_DATA("lcm-example/example.lcmlog");
  const auto file = test::data_folder() / "lcm-example/example.lcmlog";
  EventLogReader reader = open(file);
  const LcmLog log(file, "r");
  std::int64_t events = 0;
  for (; const auto event = reader.next(); ++events) {
    const std::unique_ptr<lcm_eventlog_event_t, void (*)(lcm_eventlog_event_t*)> theirs(
        lcm_eventlog_read_next_event(log.log), lcm_eventlog_free_event);
    ASSERT_TRUE(theirs);
    EXPECT_EQ(event->number, theirs->eventnum);
    EXPECT_EQ(event->utime_us, theirs->timestamp);
    EXPECT_EQ(event->channel, theirs->channel);
    EXPECT_EQ(text_of(event->data),
              std::string(static_cast<const char*>(theirs->data), static_cast<std::size_t>(theirs->datalen)));
  }
  EXPECT_EQ(events, 10);
  EXPECT_EQ(reader.damaged_bytes(), 0U);
}

TEST(EventLog, FlushedEventsAreInTheFile) {
  const test::TemporaryFolder folder;
  auto writer = EventLogWriter::create(folder / "a.lcm");
  ASSERT_TRUE(writer);
  ASSERT_FALSE(writer->write(1, "A", bytes_of("x")));
  EXPECT_EQ(std::filesystem::file_size(folder / "a.lcm"), 0U);
  ASSERT_FALSE(writer->flush());
  EXPECT_EQ(std::filesystem::file_size(folder / "a.lcm"), kEventHeaderSize + 2);
}

TEST(EventLog, FullBuffersReachTheFileByThemselves) {
  const test::TemporaryFolder folder;
  auto writer = EventLogWriter::create(folder / "a.lcm");
  ASSERT_TRUE(writer);
  const std::string data(EventLogWriter::kBufferSize, 'x');
  ASSERT_FALSE(writer->write(1, "A", bytes_of(data)));
  EXPECT_EQ(std::filesystem::file_size(folder / "a.lcm"), kEventHeaderSize + 1 + data.size());
}

TEST(EventLog, RefusesEventsBeyondTheFormat) {
  const test::TemporaryFolder folder;
  auto writer = EventLogWriter::create(folder / "a.lcm");
  ASSERT_TRUE(writer);
  EXPECT_EQ(writer->write(1, "", {}), std::errc::invalid_argument);
  EXPECT_EQ(writer->write(1, std::string(kMaxChannelLength + 1, 'C'), {}), std::errc::invalid_argument);
  EXPECT_FALSE(writer->write(1, std::string(kMaxChannelLength, 'C'), {}));
  EXPECT_EQ(writer->events(), 1U);
}

TEST(EventLog, FullDiskIsAnErrorEachTime) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  auto writer = EventLogWriter::create("/dev/full");
  ASSERT_TRUE(writer);
  for (int i = 0; i < 2; ++i) {
    ASSERT_FALSE(writer->write(1, "A", {}));
    EXPECT_EQ(writer->flush(), std::errc::no_space_on_device);
    EXPECT_EQ(writer->lost(), static_cast<std::uint64_t>(i) + 1);
  }
  EXPECT_EQ(writer->size(), 0U);
}

TEST(EventLog, SyncedEventsAreInTheFile) {
  const test::TemporaryFolder folder;
  auto writer = EventLogWriter::create(folder / "a.lcm");
  ASSERT_TRUE(writer);
  ASSERT_FALSE(writer->write(1, "A", bytes_of("x")));
  EXPECT_EQ(writer->size(), kEventHeaderSize + 2);
  ASSERT_FALSE(writer->sync());
  EXPECT_EQ(std::filesystem::file_size(folder / "a.lcm"), writer->size());
  EXPECT_EQ(writer->lost(), 0U);
}

TEST(EventLog, WhatCannotBeOpenedIsNamed) {
  const test::TemporaryFolder folder;
  const auto missing = (folder / "no/log.lcm").string();
  EXPECT_EQ(azimuth::text(EventLogReader::open(missing).error()),
            missing + ": cannot be opened: No such file or directory\n");
  EXPECT_EQ(azimuth::text(EventLogWriter::create(missing).error()),
            missing + ": cannot be written: No such file or directory\n");
  EXPECT_EQ(azimuth::text(EventLogReader::open(folder.path()).error()),
            folder.path().string() + ": is not a regular file\n");
}

}  // namespace
}  // namespace azimuth
