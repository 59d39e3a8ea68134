// The contract between those who make a report's document and the page that draws it; written out in
// README.md of this folder.
#pragma once

#include <nlohmann/json.hpp>

namespace boresight::report {

// Throws std::invalid_argument: "report document: sections[1].items[0].series[2].y: found 10 numbers,
// expected 12, as in x".
void check(const nlohmann::json& document);

// The document as it is written: numbers of series and heat maps rounded to 7 significant digits (more where
// a series varies by less than 1e-3 of its size, so that its shape is kept), NaN and infinity as null.
nlohmann::json rounded(const nlohmann::json& document);

}  // namespace boresight::report
