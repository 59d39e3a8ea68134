#include "reference/reference_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reference/key_facts.hpp"
#include "reference/topics.hpp"

namespace boresight::app {
namespace {

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Boresight {0}: reference</title>
<style>
body {{ font: 16px/1.45 system-ui, sans-serif; max-width: 70em; margin: 2em auto; padding: 0 1em; color: #1b1b1b; background: #fff; }}
h1 {{ font-size: 1.6em; }} h2 {{ font-size: 1.3em; margin-top: 2.2em; border-bottom: 1px solid #ccc; }}
h3 {{ font: 600 1.05em ui-monospace, monospace; margin: 1.8em 0 .2em; }}
code, pre {{ font: .93em ui-monospace, monospace; }} pre {{ background: #f5f5f5; padding: .8em; overflow-x: auto; }}
table {{ border-collapse: collapse; width: 100%; }} td, th {{ text-align: left; vertical-align: top; padding: .35em .7em .35em 0; }}
th {{ font-weight: 600; border-bottom: 1px solid #ccc; }} tr + tr td {{ border-top: 1px solid #eee; }}
.small {{ color: #555; font-size: .93em; }} nav ul {{ columns: 3; padding-left: 1.2em; }}
@media (max-width: 50em) {{ nav ul {{ columns: 1; }} }}
</style>
</head>
<body>
<h1>Boresight {0}: reference</h1>
<p>Every verb with its options, and every key that a file may hold. The program itself made this page, of the tables that it reads files
with: <code>boresight help --page</code>. In the terminal: <code>boresight help WORD</code>.</p>
)";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

// Text with `code` in it.
std::string html_prose(const std::string& text) {
  std::string out;
  bool code = false;
  for (const char c : escaped(text)) {
    if (c != '`') {
      out += c;
      continue;
    }
    out += code ? "</code>" : "<code>";
    code = !code;
  }
  return out;
}

std::string anchor(const Section& section) {
  return "file-" + section.file + (section.path().empty() ? "" : "-" + section.path());
}

std::string key_row(const Section& section, const Key& key) {
  std::string words;
  for (const KeyChoice& choice : key.choices)
    words += fmt::format("<br><code>{}</code>{}", escaped(choice.name),
                         choice.says.empty() ? "" : ": " + escaped(choice.says));
  std::string value = escaped(kind_text(key));
  if (const std::string range = range_text(key); !range.empty()) value += "<br>" + escaped(range);
  return fmt::format(
      "<tr id=\"{}.{}\"><td><code>{}</code></td><td>{}{}</td><td class=\"small\">{}</td><td class=\"small\">{}</td>"
      "<td class=\"small\">{}</td></tr>\n",
      anchor(section), escaped(key.name), escaped(key.name), html_prose(key.sentence), words, value,
      html_prose(presence_text(key)), escaped(verbs_text(section, &key)));
}

std::string section_part(const Section& section) {
  const std::string heading = section.path().empty() ? "at the top of the file" : section.heading();
  std::string part =
      fmt::format("<h3 id=\"{}\">{}</h3>\n<p>{}", anchor(section), escaped(heading), html_prose(section.keys->says));
  if (section.paths.size() > 1)
    part += fmt::format(" <span class=\"small\">Also [{}].</span>",
                        escaped(fmt::format("{}", fmt::join(section.paths.begin() + 1, section.paths.end(), "], ["))));
  part += "</p>\n<table><tr><th>key</th><th>what it is</th><th>value</th><th>unless given</th><th>read by</th></tr>\n";
  for (const Key& key : section.keys->keys) part += key_row(section, key);
  return part + "</table>\n";
}

std::string topic_part(const Topic& topic) {
  std::string part = fmt::format("<h3 id=\"topic-{}\">{}</h3>\n", topic.name, escaped(topic.title));
  for (const std::string& paragraph : topic.paragraphs)
    part += paragraph.starts_with(' ') ? "<pre>" + escaped(paragraph.substr(1)) + "</pre>\n"
                                       : "<p>" + html_prose(paragraph) + "</p>\n";
  return part;
}

}  // namespace

std::string reference_page(const std::vector<std::pair<std::string, std::string>>& helps) {
  std::string contents, verbs, topic_parts, files;
  for (const auto& [verb, help] : helps) {
    contents += fmt::format("<li><a href=\"#verb-{0}\">boresight {0}</a></li>\n", verb);
    verbs += fmt::format("<h3 id=\"verb-{0}\">boresight {0}</h3>\n<pre>{1}</pre>\n", verb, escaped(help));
  }
  for (const Topic& topic : topics()) {
    contents += fmt::format("<li><a href=\"#topic-{}\">{}</a></li>\n", topic.name, escaped(topic.title));
    topic_parts += topic_part(topic);
  }
  std::string file;
  for (const Section& section : sections()) {
    if (section.file != file) files += fmt::format("<h2>Keys of a {} file</h2>\n", section.file);
    file = section.file;
    contents += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", anchor(section), escaped(section.heading()));
    files += section_part(section);
  }
  return fmt::format(kHead, BORESIGHT_VERSION) + "<nav><ul>\n" + contents + "</ul></nav>\n<h2>Verbs</h2>\n" + verbs +
         "<h2>What holds everywhere</h2>\n" + topic_parts + files + "</body>\n</html>\n";
}

}  // namespace boresight::app
