#include "tools/page/html_page.hpp"

#include <algorithm>
#include <functional>
#include <glib.h>
#include <memory>
#include <set>
#include <vector>

namespace azimuth {
namespace {

constexpr std::string_view kImport = "import ", kExport = "export ", kFrom = " from './";

std::string_view text_of(std::string_view name) {
  for (const PageFile& file : page_files())
    if (file.name == name) return file.text;
  return {};
}

void append_module(std::string_view text, std::string& joined) {
  while (!text.empty()) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (line.starts_with(kImport)) continue;
    if (line.starts_with(kExport)) line.remove_prefix(kExport.size());
    joined.append(line) += '\n';
  }
}

using Names = std::set<std::string, std::less<>>;

void add_imports(std::string_view text, Names& names) {
  for (std::size_t at = text.find(kFrom); at != std::string_view::npos; at = text.find(kFrom, at + 1)) {
    const std::string_view name = text.substr(at + kFrom.size());
    names.emplace(name.substr(0, name.find('\'')));
  }
}

/// The texts of a module and of all directly or indirectly imported modules, each after its imports.
std::vector<std::string_view> modules_of(std::string_view module) {
  Names wanted{std::string(module)};
  std::vector<std::string_view> texts;
  for (std::size_t i = page_files().size(); i > 0; --i) {
    const PageFile& file = page_files()[i - 1];
    if (!wanted.contains(file.name)) continue;
    texts.push_back(file.text);
    add_imports(file.text, wanted);
  }
  std::ranges::reverse(texts);
  return texts;
}

/// The hash source of a script or style for a Content-Security-Policy.
std::string source_of(std::string_view text) { return "'sha256-" + base64(sha256(text)) + '\''; }

/// The page up to its body. `script_policy` is the part of the policy that allows a script; it may be empty.
std::string head(std::string_view title, const std::string& script_policy) {
  const std::string_view style = text_of("page.css");
  std::string page = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  page +=
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; base-uri 'none'; form-action "
      "'none'; ";
  page += "img-src data:; style-src " + source_of(style) + script_policy + "\">\n";
  page += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  page += "<meta name=\"color-scheme\" content=\"light dark\">\n<title>" + html_text(title) + "</title>\n<style>";
  page.append(style) += "</style>\n</head>\n<body>\n";
  return page;
}

}  // namespace

std::string html_text(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else if (c == '>')
      escaped += "&gt;";
    else if (c == '"')
      escaped += "&quot;";
    else
      escaped += c;
  }
  return escaped;
}

std::string json_in_html(std::string_view json) {
  std::string escaped;
  escaped.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      escaped += "\\u003c";
    else if (c == '>')
      escaped += "\\u003e";
    else if (c == '&')
      escaped += "\\u0026";
    else
      escaped += c;
  }
  return escaped;
}

std::string joined_modules(std::string_view module) {
  std::string joined = "\n";
  for (const std::string_view text : modules_of(module)) append_module(text, joined);
  return joined;
}

std::string html_page(std::string_view title, std::string_view data, std::string_view module) {
  const std::string script = joined_modules(module);
  std::string page = head(title, "; script-src " + source_of(script)) + "<main></main>\n";
  page += "<noscript>This page draws with JavaScript, all of which is in it.</noscript>\n";
  page += "<script type=\"application/json\" id=\"data\">" + json_in_html(data) + "</script>\n";
  page += "<script type=\"module\">" + script + "</script>\n</body>\n</html>\n";
  return page;
}

std::string page_without_script(std::string_view title, std::string_view body) {
  std::string page = head(title, {}) + "<main>\n";
  page.append(body) += "</main>\n</body>\n</html>\n";
  return page;
}

std::array<std::byte, 32> sha256(std::string_view text) {
  const std::unique_ptr<GChecksum, decltype(&g_checksum_free)> checksum(g_checksum_new(G_CHECKSUM_SHA256),
                                                                        &g_checksum_free);
  g_checksum_update(checksum.get(), reinterpret_cast<const guchar*>(text.data()), static_cast<gssize>(text.size()));
  std::array<std::byte, 32> digest{};
  gsize size = digest.size();
  g_checksum_get_digest(checksum.get(), reinterpret_cast<guint8*>(digest.data()), &size);
  return digest;
}

std::string base64(std::span<const std::byte> bytes) {
  const std::unique_ptr<gchar, decltype(&g_free)> text(
      g_base64_encode(reinterpret_cast<const guchar*>(bytes.data()), bytes.size()), &g_free);
  return text.get();
}

}  // namespace azimuth
