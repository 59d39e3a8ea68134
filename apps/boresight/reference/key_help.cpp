#include "reference/key_help.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "reference/key_facts.hpp"
#include "reference/topics.hpp"
#include "terminal/columns.hpp"

namespace boresight::app {
namespace {

constexpr std::size_t kWidth = 100;

// Lines of at most kWidth columns, each after this many blanks.
std::string wrapped(const std::string& text, std::size_t indent) {
  std::string lines, line;
  const auto end_line = [&] {
    if (!line.empty()) lines += std::string(indent, ' ') + line + "\n";
    line.clear();
  };
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t blank = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, blank - begin);
    if (!line.empty() && indent + columns_in(line) + 1 + columns_in(word) > kWidth) end_line();
    line += (line.empty() ? "" : " ") + word;
    begin = blank + 1;
  }
  end_line();
  return lines;
}

bool ends_with_part(const std::string& path, const std::string& part) {
  return path == part || path.ends_with("." + part);
}

std::string where(const Section& section) {
  std::string text = "in " + section.file + " files";
  if (section.paths.size() > 1)
    text += fmt::format("; also [{}]", fmt::join(section.paths.begin() + 1, section.paths.end(), "], ["));
  return text;
}

std::string section_text(const Section& section) {
  std::string text = section.heading() + (section.path().empty() ? "" : ", " + where(section)) + "\n";
  text += wrapped(section.keys->says, 2) + wrapped("Read by: " + verbs_text(section) + ".", 2) + "\n";
  for (const Key& key : section.keys->keys) {
    text += "  " + key.name + "\n" + wrapped(key.sentence, 6) + wrapped(facts_text(key), 6);
    if (!key.choices.empty()) {
      std::string words;
      for (const KeyChoice& choice : key.choices) words += (words.empty() ? "" : ", ") + choice.name;
      text += wrapped("words: " + words, 6);
    }
  }
  return text;
}

std::string key_text(const Section& section, const Key& key) {
  std::string text = fmt::format("{}, {} {}\n", key.name, section.path().empty() ? "of" : "in", section.heading()) +
                     wrapped(key.sentence, 2) + "\n";
  text += wrapped("Value: " + kind_text(key) + ".", 2);
  if (const std::string range = range_text(key); !range.empty()) text += wrapped("Range: " + range + ".", 2);
  text += wrapped((key.presence == Key::Presence::sometimes ? "When: " : "Unless given: ") +
                      (key.presence == Key::Presence::required      ? "it must be there"
                       : key.presence == Key::Presence::has_default ? default_text(key)
                                                                    : key.when) +
                      ".",
                  2);
  text += wrapped("Read by: " + verbs_text(section, &key) + ".", 2);
  std::size_t widest = 0;
  for (const KeyChoice& choice : key.choices) widest = std::max(widest, choice.name.size());
  for (const KeyChoice& choice : key.choices)
    text += fmt::format("    {:{}}{}\n", choice.name, choice.says.empty() ? 0 : widest + 2, choice.says);
  return text;
}

std::string topic_text(const Topic& topic) {
  std::string text = topic.title + "\n";
  for (const std::string& paragraph : topic.paragraphs)
    text += paragraph.starts_with(' ') ? "   " + paragraph + "\n" : "\n" + wrapped(paragraph, 2);
  return text;
}

// "clearance.F1.contact.restitution" without the name of the joint.
std::string without_name(const std::string& path) {
  for (const char* kind : {"body.", "joint.", "clearance.", "spring.", "load."}) {
    if (!path.starts_with(kind)) continue;
    const std::size_t first = path.find('.'), second = path.find('.', first + 1);
    return second == std::string::npos ? path : path.substr(0, first) + path.substr(second);
  }
  return path;
}

// Sections and keys whose paths end with the word, those that are the word first.
std::string found(const std::string& word) {
  std::vector<std::string> exact, near;
  for (const Section& section : sections()) {
    for (const std::string& path : section.paths)
      if (!path.empty() && (ends_with_part(path, word) || (path == section.path() && word == section.file))) {
        (path == word ? exact : near).push_back(section_text(section));
        break;
      }
    if (section.path().empty() && word == section.file) exact.push_back(section_text(section));
    for (const Key& key : section.keys->keys) {
      if (table_inside(key) != nullptr && key.kind != KeyKind::quantity) continue;  // the section says it
      const bool is_it = std::any_of(section.paths.begin(), section.paths.end(), [&](const std::string& path) {
        return (path.empty() ? key.name : path + "." + key.name) == word;
      });
      if (is_it || ends_with_part(section.path_of(key), word))
        (is_it && word.find('.') != std::string::npos ? exact : near).push_back(key_text(section, key));
    }
  }
  std::vector<std::string>& all = exact.empty() ? near : exact;
  return fmt::format("{}", fmt::join(all, "\n"));
}

}  // namespace

std::string key_help(const std::string& word) {
  for (const Topic& topic : topics())
    if (topic.name == word) return topic_text(topic);
  const std::string text = found(word);
  return text.empty() ? found(without_name(word)) : text;
}

std::vector<std::string> known_words() {
  std::vector<std::string> words;
  for (const Topic& topic : topics()) words.push_back(topic.name);
  for (const Section& section : sections()) {
    if (section.path().empty()) words.push_back(section.file);
    for (const std::string& path : section.paths)
      if (!path.empty()) words.push_back(path);
    for (const Key& key : section.keys->keys) {
      words.push_back(key.name);
      words.push_back(section.path_of(key));
    }
  }
  return words;
}

std::string keys_of_verb(const std::string& verb) {
  for (const Section& section : sections())
    if (section.file == "study" && section.path() == verb) return section_text(section);
  return "";
}

}  // namespace boresight::app
