// One report, one HTML file: everything a reader needs (data, charts, script, style) is inside it, and it
// opens without a network.
//
// A document (see README.md of this folder for the contract, document.hpp for the structs that build it) is
// checked, its long series are rounded, and it is placed beside the bundled page, which draws it in the
// browser.
//
//   std::ofstream file("results/report.html");
//   boresight::report::write_html(file, document);
#pragma once

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

namespace boresight::report {

// Throws std::invalid_argument if the document breaks the contract; the message names the place, what was
// found and what was expected. Nothing is written then. NaN and infinity in series become gaps. Text that is
// not UTF-8 is mended, not refused.
void write_html(std::ostream& out, const nlohmann::json& document);

// The same in two steps: the document as a report keeps it, checked and rounded; and the page of one that is.
nlohmann::json prepared(const nlohmann::json& document);
void write_page(std::ostream& out, const nlohmann::json& prepared);
// A prepared document as text, from which parsing makes it again to the last bit.
std::string document_text(const nlohmann::json& prepared);

std::string html(const nlohmann::json& document);

}  // namespace boresight::report
