// What a JSON schema says of a file.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "reference/json_schema.hpp"

namespace boresight::app {

class SchemaVerdict {
 public:
  explicit SchemaVerdict(const std::string& file) : text_(nlohmann::json::parse(json_schema(file).dump())) {
    valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(Adapter(text_), schema_);
  }
  // What is wrong, or "".
  std::string fault_of(const nlohmann::json& json) const {
    valijson::Validator validator;
    valijson::ValidationResults results;
    if (validator.validate(schema_, Adapter(json), &results)) return "";
    std::string faults;
    valijson::ValidationResults::Error error;
    while (results.popError(error)) {
      for (const std::string& part : error.context) faults += part;
      faults += ": " + error.description + "\n";
    }
    return faults.empty() ? "refused" : faults;
  }

 private:
  using Adapter = valijson::adapters::NlohmannJsonAdapter;
  nlohmann::json text_;
  valijson::Schema schema_;
};

}  // namespace boresight::app
