#include <gmock/gmock.h>

#include "tests/tools/view/seen_events.hpp"
#include "tools/view/lookers.hpp"

namespace azimuth::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

ViewEvent numbered(EventKind kind, int number) { return make_event(kind, 1, {{"number", number}}); }

/// The kinds of all events in the outbox with their numbers; -1: an event without number.
std::vector<std::pair<EventKind, int>> drained(Outbox& outbox) {
  std::vector<std::pair<EventKind, int>> all;
  while (const std::optional<ViewEvent> event = outbox.pop()) {
    std::string text = *event->text;
    all.emplace_back(event->kind, take_events(text).at(0).data.value("number", -1));
  }
  return all;
}

TEST(Outbox, GivesEventsInTheirOrder) {
  Outbox outbox;
  outbox.push(numbered(EventKind::journal, 1));
  outbox.push(numbered(EventKind::pose, 2));
  outbox.push(numbered(EventKind::journal, 3));
  EXPECT_THAT(drained(outbox), ElementsAre(std::pair(EventKind::journal, 1), std::pair(EventKind::pose, 2),
                                           std::pair(EventKind::journal, 3)));
}

TEST(Outbox, ANewerPoseTakesThePlaceOfOneThatWaits) {
  Outbox outbox;
  for (int i = 0; i < 100; ++i) outbox.push(numbered(EventKind::pose, i));
  EXPECT_EQ(outbox.size(), 1U);
  EXPECT_EQ(outbox.missed(), 99U);
  EXPECT_THAT(drained(outbox), ElementsAre(std::pair(EventKind::missed, -1), std::pair(EventKind::pose, 99)));
}

TEST(Outbox, TellsHowManyWereMissed) {
  Outbox outbox;
  for (int i = 0; i < 4; ++i) outbox.push(numbered(EventKind::map, i));
  EXPECT_THAT(*outbox.pop()->text, HasSubstr(R"("n":3)"));
  outbox.pop();
  EXPECT_EQ(outbox.missed(), 0U);
  outbox.push(numbered(EventKind::map, 5));
  EXPECT_EQ(outbox.pop()->kind, EventKind::map) << "told once";
}

TEST(Outbox, IsBoundedWhateverIsPushed) {
  Outbox outbox;
  std::uint64_t pushed = 0;
  for (int i = 0; i < 1000; ++i)
    for (std::size_t kind = 0; kind < kEventKinds; ++kind, ++pushed)
      outbox.push(numbered(static_cast<EventKind>(kind), i));
  EXPECT_LE(outbox.size(), Outbox::kMostLines + kEventKinds);
  EXPECT_EQ(outbox.missed() + outbox.size(), pushed) << "each is there, or counted";
}

TEST(Outbox, KeepsTheNewestLines) {
  Outbox outbox;
  for (int i = 0; i < 100; ++i) outbox.push(numbered(EventKind::journal, i));
  const auto all = drained(outbox);
  ASSERT_EQ(all.size(), 1 + Outbox::kMostLines);
  EXPECT_EQ(all.back().second, 99);
  EXPECT_EQ(all[1].second, 100 - static_cast<int>(Outbox::kMostLines));
}

}  // namespace
}  // namespace azimuth::test
