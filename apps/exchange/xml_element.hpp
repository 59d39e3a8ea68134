// An element of an XML file that was read, with its line; what is missing or wrong in it is one InputError of the file's line.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "boresight/mechanism/error.hpp"

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace boresight::app {

class XmlElement {
 public:
  // The root of a document. Throws InputError for text that is no XML.
  static XmlElement root_of(const std::string& text, const std::string& filename);

  std::string tag() const;
  Origin origin() const;
  int line() const { return origin().line; }

  // The first child of this tag.
  std::optional<XmlElement> child(const std::string& tag) const;
  // Throws where there is none.
  XmlElement needed(const std::string& tag) const;
  // All children, of this tag or of any.
  std::vector<XmlElement> children(const std::string& tag = "") const;

  bool has(const std::string& attribute) const;
  std::string text(const std::string& attribute) const;  // throws where there is none
  std::string text(const std::string& attribute, const std::string& otherwise) const;
  double number(const std::string& attribute) const;
  double number(const std::string& attribute, double otherwise) const;
  Vec3 vector(const std::string& attribute, const Vec3& otherwise) const;

  // What stands between its tags.
  std::string content() const;
  double content_number() const;
  Vec3 content_vector() const;
  std::vector<double> content_numbers() const;
  bool content_flag() const;  // true, false, 1 or 0

  // A direction: of unit length from now on. Throws for zero.
  Vec3 direction(const Vec3& given, const std::string& key) const;

  [[noreturn]] void fail(const std::string& key, const std::string& found, const std::string& expected,
                         const std::string& nearest = "") const;

 private:
  XmlElement(std::shared_ptr<const tinyxml2::XMLDocument> document, std::shared_ptr<const std::string> file,
             const tinyxml2::XMLElement* element);
  // What is read: the text, refused where it is not UTF-8. What is not read, comments among it, may be anything.
  std::string in_utf8(const std::string& key, const std::string& text) const;
  double number_of(const std::string& key, const std::string& text) const;
  std::vector<double> numbers_of(const std::string& key, const std::string& text) const;
  Vec3 vector_of(const std::string& key, const std::string& text) const;

  std::shared_ptr<const tinyxml2::XMLDocument> document_;
  std::shared_ptr<const std::string> file_;
  const tinyxml2::XMLElement* element_;
};

}  // namespace boresight::app
