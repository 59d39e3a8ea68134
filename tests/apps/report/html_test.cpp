// The file as text: self-contained, escaped, and readable back.
#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

#include "report/report.hpp"
#include "sample.hpp"

namespace boresight::report {
namespace html_test {

using nlohmann::json;

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

std::string data_of(const std::string& page) {
  const std::string opening = "<script type=\"application/json\" id=\"document\">";
  const std::size_t begin = page.find(opening) + opening.size();
  return page.substr(begin, page.find("</script>", begin) - begin);
}

TEST(Html, HoldsTheDocumentUnchanged) {
  const json document = sample::hostile();
  const json back = json::parse(data_of(html(document)));
  EXPECT_EQ(back["title"], document["title"]);
  EXPECT_EQ(back["sections"][0]["items"][0], document["sections"][0]["items"][0]);
}

TEST(Html, CannotBeBrokenOutOf) {
  const std::string page = html(sample::hostile());
  EXPECT_EQ(count(page, "</script"),
            2u);  // the data's and the page's own: none from the data, none inside the bundle
  EXPECT_EQ(count(page, "<script>document.title"), 0u);
  EXPECT_EQ(count(page, "<b>bold"), 0u);
  EXPECT_NE(page.find("<title>&lt;/script&gt;&lt;script&gt;"), std::string::npos);
}

TEST(Html, AsksForNothingOutsideItself) {
  const std::string page = html(sample::every_kind());
  EXPECT_EQ(count(page, "<script src"), 0u);
  EXPECT_EQ(count(page, "<link"), count(page, "<link rel=\"icon\" href=\"data:,\">"));
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
}

TEST(Html, CarriesThePlotlyNoticeAndItsTerms) {
  const std::string page = html(sample::every_kind());
  EXPECT_EQ(count(page, "Copyright: 2012-2021, Plotly, Inc."), 1u);
  EXPECT_EQ(count(page, "Permission is hereby granted, free of charge, to any person obtaining"), 1u);
}

TEST(Html, MendsTextThatIsNotUtf8) {
  const std::string page = html({{"title", "broken \xC3( text"}, {"sections", json::array()}});
  EXPECT_NE(page.find("<title>broken \xEF\xBF\xBD( text</title>"), std::string::npos);
}

TEST(Html, WritesNothingOfADocumentThatBreaksTheContract) {
  std::ostringstream out;
  EXPECT_THROW(write_html(out, {{"title", "T"}}), std::invalid_argument);
  EXPECT_TRUE(out.str().empty());
}

TEST(Html, StaysSmall) {
  EXPECT_LT(html({{"title", "T"}, {"sections", json::array()}}).size(), 1'800'000u);
  EXPECT_LT(html(sample::every_kind()).size(), 2'300'000u);
}

}  // namespace html_test
}  // namespace boresight::report
