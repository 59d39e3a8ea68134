// Which texts a key of a quantity may have, as a regular expression: for who has no table of units, as editors have none.
//
// It refuses no text that the reader takes. Units are open: UDUNITS knows some thousand names, prefixes before them and products of both,
// and whoever installs it may add some. So what is refused are texts that are no number with a unit, another sign, and in the common units, which
// are known here, those of another dimension and sizes beyond the largest by orders of magnitude.
#pragma once

#include <string>

#include "boresight/keys/key.hpp"

namespace boresight::app {

// key: a quantity, a list or a vector of them, or a value whose unit its reader knows.
std::string quantity_pattern(const Key& key);

}  // namespace boresight::app
