#include "report/report.hpp"

#include <ostream>
#include <sstream>
#include <string_view>

#include "page/bundle.hpp"
#include "report/contract.hpp"

namespace boresight::report {
namespace {

using nlohmann::json;

// Text into HTML: nothing in it can open a tag or end an attribute.
std::string escaped(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

// JSON into a script element. In JSON text '<' and '>' occur only inside strings, where \u003c means the
// same; with them escaped neither "</script>" nor "<!--" can occur. All that is not ASCII is escaped too.
std::string script_data(const json& document) {
  const std::string text = document_text(document);
  std::string result;
  result.reserve(text.size() + text.size() / 64);
  for (const char c : text) {
    switch (c) {
      case '<':
        result += "\\u003c";
        break;
      case '>':
        result += "\\u003e";
        break;
      case '&':
        result += "\\u0026";
        break;
      default:
        result += c;
    }
  }
  return result;
}

// A string as JSON writes it after mending, without quotes and escapes: the same repair of broken UTF-8 for
// title and data.
std::string mended(const json& text) {
  return json::parse(text.dump(-1, ' ', true, json::error_handler_t::replace)).get<std::string>();
}

}  // namespace

json prepared(const json& document) {
  check(document);
  return rounded(document);
}

std::string document_text(const json& prepared) { return prepared.dump(-1, ' ', true, json::error_handler_t::replace); }

void write_html(std::ostream& out, const json& document) { write_page(out, prepared(document)); }

void write_page(std::ostream& out, const json& document) {
  const std::string title = escaped(mended(document.at("title")));
  const std::string verdict =
      document.contains("verdict") ? escaped(mended(document.at("verdict").at("text"))) : std::string();
  // The policy forbids every request: a report that tried to reach the network would fail its browser test.
  out << "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src "
         "'unsafe-inline'; "
         "style-src 'unsafe-inline'; img-src data: blob:\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta name=\"color-scheme\" content=\"light dark\">\n"
         "<meta name=\"generator\" content=\"Boresight\">\n"
         "<link rel=\"icon\" href=\"data:,\">\n"
         "<title>"
      << title << "</title>\n<style>" << bundled_style()
      << "</style>\n</head>\n<body>\n<div id=\"report\"></div>\n<noscript><h1>" << title << "</h1><p>" << verdict
      << "</p><p>The charts and tables of this report are drawn by a script inside the file. Allow scripts "
         "to see "
         "them.</p></noscript>\n<script type=\"application/json\" id=\"document\">"
      << script_data(document) << "</script>\n<script>" << bundled_script() << "</script>\n</body>\n</html>\n";
}

std::string html(const json& document) {
  std::ostringstream out;
  write_html(out, document);
  return std::move(out).str();
}

}  // namespace boresight::report
