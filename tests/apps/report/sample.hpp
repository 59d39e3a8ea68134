// A document with every kind of item, made up but of the shape and size of a real run: what the tests draw.
#pragma once

#include "report/document.hpp"

namespace boresight::report::sample {

Document every_kind();

// Titles and texts that would break a page which pastes them in unescaped.
Document hostile();

// As many charts as the largest study has, with long series.
Document many_charts(int charts, int points);

}  // namespace boresight::report::sample
