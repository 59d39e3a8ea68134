#include "exchange/xml_element.hpp"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <charconv>
#include <cmath>

#include "exchange/utf8.hpp"

namespace boresight::app {
namespace {

std::string in_marks(const std::string& text) { return "\"" + text + "\""; }

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

// ISO-8859-1 of <?xml version="1.0" encoding="ISO-8859-1"?>; "" where the file declares none.
std::string declared_encoding(const tinyxml2::XMLDocument& document) {
  const tinyxml2::XMLNode* first = document.FirstChild();
  if (first == nullptr || first->ToDeclaration() == nullptr) return "";
  const std::string words = first->Value();
  const std::size_t key = words.find("encoding");
  const std::size_t begin = key == std::string::npos ? key : words.find_first_of("\"'", key);
  const std::size_t end = begin == std::string::npos ? begin : words.find(words[begin], begin + 1);
  return end == std::string::npos ? "" : words.substr(begin + 1, end - begin - 1);
}

}  // namespace

XmlElement::XmlElement(std::shared_ptr<const tinyxml2::XMLDocument> document, std::shared_ptr<const std::string> file,
                       const tinyxml2::XMLElement* element)
    : document_(std::move(document)), file_(std::move(file)), element_(element) {}

XmlElement XmlElement::root_of(const std::string& text, const std::string& filename) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    throw InputError({filename, 1}, "", "a text in UTF-16", "one in UTF-8: save it as that");
  auto document = std::make_shared<tinyxml2::XMLDocument>();
  const auto fault = document->Parse(text.data(), text.size());
  if (fault == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED)
    throw InputError({filename, document->ErrorLineNum()}, "", "elements nested more than 500 deep", "fewer");
  if (fault != tinyxml2::XML_SUCCESS) {
    std::string what = tinyxml2::XMLDocument::ErrorIDToName(fault);  // XML_ERROR_MISMATCHED_ELEMENT
    if (what.starts_with("XML_ERROR_")) what.erase(0, 10);
    if (what.starts_with("XML_")) what.erase(0, 4);
    for (char& c : what) c = c == '_' ? ' ' : static_cast<char>(c >= 'A' && c <= 'Z' ? c + ('a' - 'A') : c);
    throw InputError({filename, document->ErrorLineNum()}, "", "text that is no XML (" + what + ")", "an XML file");
  }
  const tinyxml2::XMLElement* root = document->RootElement();
  if (root == nullptr) throw InputError({filename, 0}, "", "no XML element", "an XML file");
  return {std::move(document), std::make_shared<const std::string>(filename), root};
}

std::string XmlElement::tag() const { return in_utf8("", element_->Name()); }
Origin XmlElement::origin() const { return {*file_, element_->GetLineNum()}; }

std::optional<XmlElement> XmlElement::child(const std::string& tag) const {
  const tinyxml2::XMLElement* found = element_->FirstChildElement(tag.c_str());
  if (found == nullptr) return std::nullopt;
  return XmlElement(document_, file_, found);
}

XmlElement XmlElement::needed(const std::string& tag) const {
  const std::optional<XmlElement> found = child(tag);
  if (!found) fail(tag, "no <" + tag + ">", "one in this <" + this->tag() + ">");
  return *found;
}

std::vector<XmlElement> XmlElement::children(const std::string& tag) const {
  std::vector<XmlElement> found;
  const char* name = tag.empty() ? nullptr : tag.c_str();
  for (const auto* e = element_->FirstChildElement(name); e != nullptr; e = e->NextSiblingElement(name))
    found.push_back(XmlElement(document_, file_, e));
  return found;
}

bool XmlElement::has(const std::string& attribute) const { return element_->Attribute(attribute.c_str()) != nullptr; }

std::string XmlElement::text(const std::string& attribute) const {
  const char* found = element_->Attribute(attribute.c_str());
  if (found == nullptr) fail(tag() + "." + attribute, "nothing", "a value");
  return in_utf8(tag() + "." + attribute, found);
}

std::string XmlElement::text(const std::string& attribute, const std::string& otherwise) const {
  return has(attribute) ? text(attribute) : otherwise;
}

double XmlElement::number(const std::string& attribute) const {
  return number_of(tag() + "." + attribute, text(attribute));
}

double XmlElement::number(const std::string& attribute, double otherwise) const {
  return has(attribute) ? number(attribute) : otherwise;
}

Vec3 XmlElement::vector(const std::string& attribute, const Vec3& otherwise) const {
  return has(attribute) ? vector_of(tag() + "." + attribute, text(attribute)) : otherwise;
}

std::string XmlElement::content() const {
  const char* found = element_->GetText();
  std::string text = found == nullptr ? "" : in_utf8(tag(), found);
  while (!text.empty() && is_space(text.back())) text.pop_back();
  while (!text.empty() && is_space(text.front())) text.erase(0, 1);
  return text;
}

double XmlElement::content_number() const { return number_of(tag(), content()); }
Vec3 XmlElement::content_vector() const { return vector_of(tag(), content()); }
std::vector<double> XmlElement::content_numbers() const { return numbers_of(tag(), content()); }

bool XmlElement::content_flag() const {
  const std::string text = content();
  if (text == "true" || text == "1") return true;
  if (text != "false" && text != "0") fail(tag(), in_marks(text), "true or false");
  return false;
}

Vec3 XmlElement::direction(const Vec3& given, const std::string& key) const {
  const double length = given.norm();
  if (!(length > 1e-12)) fail(key, "a direction of length zero", "a direction");
  return given / length;
}

void XmlElement::fail(const std::string& key, const std::string& found, const std::string& expected,
                      const std::string& nearest) const {
  throw InputError(origin(), key, found, expected, nearest);
}

std::string XmlElement::in_utf8(const std::string& key, const std::string& text) const {
  const std::size_t at = first_byte_not_utf8(text);
  if (at == std::string::npos) return text;
  const std::string encoding = declared_encoding(*document_);
  fail(key, byte_in_words(text[at]) + " (the file declares " + (encoding.empty() ? "no encoding" : encoding) + ")",
       "UTF-8: save the file as that");
}

double XmlElement::number_of(const std::string& key, const std::string& text) const {
  const std::vector<double> numbers = numbers_of(key, text);
  if (numbers.size() != 1) fail(key, in_marks(text), "a number");
  return numbers.front();
}

std::vector<double> XmlElement::numbers_of(const std::string& key, const std::string& text) const {
  std::vector<double> numbers;
  const char *at = text.data(), *const end = at + text.size();
  for (;;) {
    while (at != end && is_space(*at)) ++at;
    if (at == end) return numbers;
    if (*at == '+') ++at;
    double value = 0.0;
    const auto [next, fault] = std::from_chars(at, end, value);
    if (fault != std::errc() || (next != end && !is_space(*next)) || !std::isfinite(value))
      fail(key, in_marks(text), "finite numbers");
    numbers.push_back(value);
    at = next;
  }
}

Vec3 XmlElement::vector_of(const std::string& key, const std::string& text) const {
  const std::vector<double> numbers = numbers_of(key, text);
  if (numbers.size() != 3) fail(key, in_marks(text), "three numbers");
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace boresight::app
