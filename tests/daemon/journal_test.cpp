// Events as the journal receives them. A stand-in for the journal's library stores what it is sent.

#include "daemon/journal/journal.hpp"

#include <gmock/gmock.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>
#include <sstream>
#include <sys/uio.h>

namespace {

std::vector<std::string> sent;
int outcome = 0;

}  // namespace

extern "C" int sd_journal_sendv(const iovec* pieces, int count) {
  for (int i = 0; i < count; ++i) sent.emplace_back(static_cast<const char*>(pieces[i].iov_base), pieces[i].iov_len);
  return outcome;
}

namespace azimuth {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

class Journal : public ::testing::Test {
 protected:
  Journal() {
    sent.clear();
    outcome = 0;
    auto logger = std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(text_));
    logger->set_level(spdlog::level::info);
    spdlog::set_default_logger(std::move(logger));
  }
  ~Journal() override { log_to_journal(false); }

  std::ostringstream text_;
};

TEST_F(Journal, GetsAnEventWithItsFields) {
  log_to_journal(true);
  log_event(JournalEvent::device_trouble, "camera: gone\nfor good = yes", {.device = "camera"});
  EXPECT_THAT(sent, Contains("MESSAGE=camera: gone\\nfor good = yes"));
  EXPECT_THAT(sent, Contains("PRIORITY=4"));
  EXPECT_THAT(sent, Contains("SYSLOG_IDENTIFIER=azimuthd"));
  EXPECT_THAT(sent, Contains("AZIMUTH_EVENT=device_trouble"));
  EXPECT_THAT(sent, Contains("AZIMUTH_DEVICE=camera"));
  EXPECT_THAT(sent, Contains(StartsWith("MESSAGE_ID=")));
  EXPECT_THAT(sent, Not(Contains(StartsWith("AZIMUTH_STAGE="))));
  EXPECT_EQ(text_.str(), "") << "not twice";
}

TEST_F(Journal, IsNotTroubledWhereThereIsNone) {
  log_event(JournalEvent::stage_late, "estimator hangs", {.stage = "estimator"});
  EXPECT_THAT(sent, IsEmpty());
  EXPECT_THAT(text_.str(), HasSubstr("estimator hangs"));
}

TEST_F(Journal, ThatFailsLosesNothing) {
  log_to_journal(true);
  outcome = -ENOENT;
  log_event(JournalEvent::map_saved, "the map is saved");
  EXPECT_THAT(text_.str(), HasSubstr("the map is saved"));
}

TEST_F(Journal, GetsOnlyWhatIsSevereEnough) {
  log_to_journal(true);
  spdlog::default_logger()->set_level(spdlog::level::err);
  log_event(JournalEvent::device_trouble, "unplugged");
  EXPECT_THAT(sent, IsEmpty());
  log_event(JournalEvent::stage_late, "hangs", {.stage = "camera"});
  EXPECT_THAT(sent, Contains("PRIORITY=3"));
  EXPECT_THAT(sent, Contains("AZIMUTH_STAGE=camera"));
}

TEST_F(Journal, KnowsEachEventByAnIdentifierOfItsOwn) {
  std::vector<std::string> ids;
  for (int event = 0; event <= static_cast<int>(JournalEvent::realtime_refused); ++event) {
    for (const std::string& field : journal_fields(static_cast<JournalEvent>(event), "", {})) {
      if (!field.starts_with("MESSAGE_ID=")) continue;
      EXPECT_THAT(ids, Not(Contains(field)));
      EXPECT_EQ(field.size(), 11u + 32u);
      ids.push_back(field);
    }
  }
  EXPECT_EQ(ids.size(), 11u);
}

}  // namespace
}  // namespace azimuth
