#include "tools/view/news.hpp"

#include <gmock/gmock.h>

namespace azimuth::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> texts(const std::vector<News>& news) {
  std::vector<std::string> all;
  for (const News& each : news) all.push_back(std::string(each.level) + ": " + each.text);
  return all;
}

status_t tracking() {
  status_t status{};
  status.health = 1;
  status.odometer = "running";
  return status;
}

TEST(StatusNews, TheFirstSaysHowThingsAre) {
  StatusNews news;
  EXPECT_THAT(texts(news.take(tracking())), ElementsAre("info: tracking", "info: odometer: running"));
}

TEST(StatusNews, TheNextOnlyWhatChanged) {
  StatusNews news;
  news.take(tracking());
  EXPECT_THAT(texts(news.take(tracking())), IsEmpty());
  status_t status = tracking();
  status.health = 3;
  status.reason = "nothing agrees";
  status.odometer = "/dev/pioneer: No such file or directory";
  status.map_trouble = "disk full";
  EXPECT_THAT(texts(news.take(status)),
              ElementsAre("error: lost: nothing agrees", "info: odometer: /dev/pioneer: No such file or directory",
                          "warning: map file: disk full"));
  EXPECT_THAT(texts(news.take(tracking())),
              ElementsAre("info: tracking", "info: odometer: running", "info: map file: well again"));
}

TEST(StatusNews, AHealthOfAnotherVersionIsSaid) {
  StatusNews news;
  status_t status = tracking();
  status.health = 77;
  EXPECT_EQ(news.take(status)[0].level, "warning");
}

}  // namespace
}  // namespace azimuth::test
