#include "tools/page/html_page.hpp"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>
#include <vector>

namespace azimuth {
namespace {

using testing::HasSubstr;
using testing::Not;

std::size_t times_in(const std::string& page, std::string_view word) {
  std::size_t count = 0;
  for (std::size_t at = page.find(word); at != std::string::npos; at = page.find(word, at + 1)) ++count;
  return count;
}

std::string between(const std::string& page, std::string_view begin, std::string_view end) {
  const std::size_t from = page.find(begin) + begin.size();
  return page.substr(from, page.find(end, from) - from);
}

TEST(HtmlPage, NothingInItsDataEndsAScript) {
  const std::string page =
      html_page("<b>\"a\" & 'b'</b>", R"({"name": "</script><script>alert(1)</script><!-- & \u2028"})");
  EXPECT_EQ(times_in(page, "</script>"), 2u);
  EXPECT_EQ(times_in(page, "<script"), 2u);
  EXPECT_EQ(times_in(page, "<!--"), 0u);
  EXPECT_THAT(page, HasSubstr("<title>&lt;b&gt;&quot;a&quot; &amp; 'b'&lt;/b&gt;</title>"));
  EXPECT_THAT(
      page, HasSubstr(R"("\u003c/script\u003e\u003cscript\u003ealert(1)\u003c/script\u003e\u003c!-- \u0026 \u2028")"));
}

TEST(HtmlPage, LetsNothingRunButItsOwnScript) {
  const std::string page = html_page("run", "{}");
  const std::string policy = between(page, "Content-Security-Policy\" content=\"", "\"");
  const std::string script = between(page, "<script type=\"module\">", "</script>");
  const std::string style = between(page, "<style>", "</style>");
  EXPECT_THAT(policy, HasSubstr("default-src 'none'"));
  EXPECT_THAT(policy, HasSubstr("script-src 'sha256-" + base64(sha256(script)) + "'"));
  EXPECT_THAT(policy, HasSubstr("style-src 'sha256-" + base64(sha256(style)) + "'"));
  EXPECT_THAT(policy, Not(HasSubstr("unsafe")));
  EXPECT_EQ(script, joined_modules());
}

TEST(HtmlPage, LoadsNothing) {
  const std::string page = html_page("run", "{}");
  for (const std::string_view word :
       {"http:", "https:", "src=\"", "href", "@import", "url(", "fetch(", "XMLHttpRequest"})
    EXPECT_EQ(times_in(page, word), 0u) << word;
}

TEST(HtmlPage, WithoutScriptItRunsNone) {
  const std::string page = page_without_script("a & b", "<p>words</p>");
  EXPECT_THAT(page, HasSubstr("<title>a &amp; b</title>"));
  EXPECT_THAT(page, HasSubstr("<main>\n<p>words</p></main>"));
  EXPECT_EQ(times_in(page, "<script"), 0u);
  const std::string policy = between(page, "Content-Security-Policy\" content=\"", "\"");
  EXPECT_THAT(policy, HasSubstr("default-src 'none'"));
  EXPECT_THAT(policy, HasSubstr("style-src 'sha256-" + base64(sha256(between(page, "<style>", "</style>"))) + "'"));
  EXPECT_THAT(policy, Not(HasSubstr("script-src")));
}

TEST(HtmlPage, EveryModuleIsInItWithoutImports) {
  const std::string modules = joined_modules();
  EXPECT_EQ(times_in(modules, "\nimport "), 0u);
  EXPECT_EQ(times_in(modules, "\nexport "), 0u);
  for (const std::string_view word :
       {"class MapView", "class TimeChart", "class HealthBar", "class TimeLink", "function showReport("})
    EXPECT_EQ(times_in(modules, word), 1u) << word;
}

TEST(HtmlPage, NothingOfTheLivePageIsInIt) {
  const std::string modules = joined_modules();
  for (const std::string_view word : {"class LiveStore", "class LiveMap", "EventSource", "run.json"})
    EXPECT_EQ(times_in(modules, word), 0u) << word;
}

TEST(PageFiles, EachStandsAfterThoseItImports) {
  std::set<std::string> before;
  for (const PageFile& file : page_files()) {
    const std::string text(file.text);
    ASSERT_FALSE(text.empty()) << file.name;
    for (std::size_t at = text.find("from './"); at != std::string::npos; at = text.find("from './", at + 1)) {
      const std::string imported = text.substr(at + 8, text.find('\'', at + 8) - at - 8);
      EXPECT_TRUE(before.contains(imported)) << file.name << " imports " << imported;
    }
    before.emplace(file.name);
  }
}

/// All values that the page gives to an attribute, in order.
std::vector<std::string> values_of(const std::string& page, const std::string& attribute) {
  std::vector<std::string> values;
  const std::string begin = ' ' + attribute + "=\"";
  for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at + 1))
    values.push_back(page.substr(at + begin.size(), page.find('"', at + begin.size()) - at - begin.size()));
  return values;
}

TEST(PageFiles, PagesLoadWhatIsThereAndHoldNoScriptOfTheirOwn) {
  std::set<std::string> names;
  for (const PageFile& file : page_files()) names.emplace(file.name);
  for (const PageFile& file : page_files()) {
    if (!file.name.ends_with(".html")) continue;
    const std::string page(file.text);
    EXPECT_EQ(times_in(page, "<script"), times_in(page, "<script type=\"module\" src=")) << file.name;
    EXPECT_EQ(times_in(page, "<style") + times_in(page, " style=") + times_in(page, " on"), 0u) << file.name;
    for (const std::string attribute : {"src", "href"})
      for (const std::string& value : values_of(page, attribute))
        EXPECT_TRUE(value.starts_with("data:") || (value.starts_with("modules/") && names.contains(value.substr(8))))
            << file.name << ": " << value;
  }
  EXPECT_TRUE(names.contains("page.html"));
}

}  // namespace
}  // namespace azimuth
