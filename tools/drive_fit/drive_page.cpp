#include "tools/drive_fit/drive_page.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <span>
#include <utility>

#include "base/visible.hpp"
#include "tools/page/html_page.hpp"

namespace azimuth {
namespace {

std::string html(const std::string& text) { return html_text(visible(text)); }

std::string cell(const std::string& text, const char* kind) {
  return fmt::format("<td class=\"{}\">{}</td>", kind, text.empty() ? "\u2013" : html(text));
}

/// A table whose head names the columns. Rows are HTML.
std::string table(const std::vector<std::pair<std::string, const char*>>& columns, const std::string& rows) {
  std::string head;
  for (const auto& [name, kind] : columns)
    head += fmt::format("<th scope=\"col\" class=\"{}\">{}</th>", kind, html(name));
  return fmt::format(
      "<div class=\"scroll\" tabindex=\"0\"><table><thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody></table></div>\n",
      head, rows);
}

std::string section(const std::string& title, const std::string& content) {
  return fmt::format("<section class=\"card\"><h2>{}</h2>\n{}</section>\n", html(title), content);
}

std::string tile(std::ptrdiff_t count, const char* label) {
  return fmt::format(
      "<div class=\"card tile\"><div class=\"value number\">{}</div><div class=\"label\">{}</div></div>\n", count,
      label);
}

std::string tiles(const DrivePage& page) {
  const auto replaced = std::ranges::count_if(page.found, &FoundValue::is_replaced);
  return "<section class=\"tiles\" aria-label=\"Summary\">\n" + tile(replaced, "values replaced or new") +
         tile(std::ssize(page.found) - replaced, "values kept") +
         tile(std::ssize(page.untold), "the drive cannot tell") + "</section>\n";
}

std::string found_section(const DrivePage& page) {
  std::string rows;
  for (const FoundValue& each : page.found)
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td><code>{}</code></td>", html(each.part), html(each.key)) +
            cell(each.said, "number") + cell(each.found, "number") + cell(each.two_sigma, "number") +
            cell(each.judgement, each.is_replaced ? "words replaced" : "words") + "</tr>\n";
  const char* const said = page.rig_file.empty() ? "default" : "the rig had";
  return section("What was found", table({{"part", ""},
                                          {"key in rig.toml", ""},
                                          {said, "number"},
                                          {"the drive says", "number"},
                                          {"\u00b1 2\u03c3", "number"},
                                          {"judgement", ""}},
                                         rows));
}

std::string untold_section(const DrivePage& page) {
  std::string rows;
  for (const UntoldValue& each : page.untold)
    rows += fmt::format("<tr><th scope=\"row\">{}</th>", html(each.part)) + cell(each.what_would, "words") + "</tr>\n";
  return section("What the drive cannot tell, and what would",
                 table({{"part", ""}, {"cannot tell; what would tell", ""}}, rows));
}

std::string figure_section(const PageFigure& figure) {
  return section(figure.name, fmt::format("<figure><figcaption class=\"faint\">{}</figcaption><img alt=\"{}\" "
                                          "src=\"{}\"></figure>\n",
                                          html(figure.caption), html(figure.name), html_text(figure.source)));
}

std::string rig_section(const DrivePage& page) {
  return section("rig.toml",
                 "<p class=\"faint\">The file that <code>--out</code> writes. A click selects all of it.</p>\n<pre "
                 "tabindex=\"0\">" +
                     html_text(visible_lines(page.rig_text)) + "</pre>\n");
}

}  // namespace

tl::expected<std::string, std::string> figure_source(PlotCanvas picture, PlotFormat format) {
  return picture.file_bytes().map([format](const std::string& bytes) {
    return std::string(format == PlotFormat::svg ? "data:image/svg+xml" : "data:image/png") + ";base64," +
           base64(std::as_bytes(std::span(bytes)));
  });
}

std::string drive_page(const DrivePage& page) {
  const std::string title = page.run + ": what the drive tells of the rig";
  std::string body =
      fmt::format("<header class=\"top\"><h1>{}</h1><span class=\"faint\">{} \u00b7 {}</span></header>\n", html(title),
                  page.rig_file.empty() ? "there was no rig.toml" : html(page.rig_file), html(page.made_by));
  body += "<div class=\"calibration\">\n" + tiles(page);
  if (!page.found.empty()) body += found_section(page);
  if (!page.untold.empty()) body += untold_section(page);
  for (const PageFigure& figure : page.figures) body += figure_section(figure);
  return page_without_script(visible(title) + " - Azimuth", body + rig_section(page) + "</div>\n");
}

}  // namespace azimuth
