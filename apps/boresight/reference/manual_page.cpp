#include "reference/manual_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "reference/topics.hpp"

namespace boresight::app {
namespace {

// What roff would read as a request, an escape or a typographer's sign stands for itself.
std::string plain(const std::string& text) {
  std::string out;
  bool line_begins = true;
  for (const char c : text) {
    if (line_begins && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else if (c == '`')
      out += "\\(ga";
    else if (c == '\'')
      out += "\\(aq";
    else if (c == '^')
      out += "\\(ha";
    else if (c == '~')
      out += "\\(ti";
    else
      out += c;
    line_begins = c == '\n';
  }
  return out;
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

// Prose, with what stands in backquotes in bold.
std::string prose(const std::string& text) {
  std::string out, word;
  bool code = false;
  for (const char c : text) {
    if (c != '`') {
      word += c;
      continue;
    }
    out += code ? "\\fB" + plain(word) + "\\fR" : plain(word);
    word.clear();
    code = !code;
  }
  return out + plain(word);
}

}  // namespace

std::string manual_page(const std::string& summary, const std::vector<std::pair<std::string, std::string>>& helps) {
  std::string page = fmt::format(
      ".TH BORESIGHT 1 \"\" \"boresight {}\" \"User Commands\"\n.SH NAME\nboresight \\- {}\n.SH SYNOPSIS\n"
      ".B boresight\n.I VERB FILE\n.RI [ options ]\n.br\n.B boresight help\n.RI [ WORD ]\n.br\n.B boresight "
      "\\-\\-version\n.SH DESCRIPTION\nBoresight follows the motion of a mechanism whose joints have clearance, and "
      "tells how far off it points. Mechanisms and studies are TOML files; each verb answers one question about them "
      "and writes its results into a folder.\n.PP\n.B boresight help\n.I WORD\nexplains a key of a file; the whole "
      "reference is in\n.I reference.html\nbeside the examples, in the documentation's folder of this package.\n",
      BORESIGHT_VERSION, plain(summary));
  page += ".SH VERBS\n";
  for (const auto& [verb, help] : helps)
    page += fmt::format(".SS boresight {}\n.nf\n{}\n.fi\n", plain(verb), plain(help));
  for (const Topic& topic : topics()) {
    page += fmt::format(".SH {}\n", plain(upper(topic.title)));
    bool example = false;  // lines that are shown as they are written
    for (const std::string& paragraph : topic.paragraphs) {
      const bool shown = paragraph.starts_with(' ');
      if (shown != example) page += shown ? ".PP\n.nf\n.RS 4\n" : ".RE\n.fi\n";
      page += shown ? plain(paragraph.substr(1)) + "\n" : ".PP\n" + prose(paragraph) + "\n";
      example = shown;
    }
    if (example) page += ".RE\n.fi\n";
  }
  return page;
}

}  // namespace boresight::app
