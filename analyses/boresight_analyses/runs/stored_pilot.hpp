// A pilot's result as text, for the store of the study that it chose a rung for: a study that goes on says what its first start said.
#pragma once

#include <optional>
#include <string>

#include "boresight_analyses/study/pilot.hpp"

namespace boresight {

std::string text_of(const PilotResult& pilot);
// Nothing where the text is none of text_of()'s.
std::optional<PilotResult> pilot_of_text(const std::string& text);

}  // namespace boresight
