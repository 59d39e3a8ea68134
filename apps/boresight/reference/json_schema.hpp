// JSON Schemas (draft 7, which editors know best) of mechanism and study files.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace boresight::app {

// file: "mechanism" or "study". Throws std::out_of_range for another.
nlohmann::ordered_json json_schema(const std::string& file);

}  // namespace boresight::app
