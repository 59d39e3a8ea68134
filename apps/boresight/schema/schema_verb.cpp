// boresight schema mechanism|study: the JSON Schema by which editors complete and check such files.
#include <algorithm>
#include <iostream>

#include "boresight/mechanism/error.hpp"
#include "command_line/verb.hpp"
#include "reference/json_schema.hpp"
#include "terminal/exit_status.hpp"

namespace boresight::app {
namespace {

class SchemaVerb : public Verb {
 public:
  std::string name() const override { return "schema"; }
  std::string file_kind() const override { return "kind of"; }
  std::string operand() const override { return "KIND"; }
  std::string operand_is() const override { return "the kind of files: mechanism or study"; }
  std::string summary() const override { return "JSON Schema of mechanism or study files, for editors"; }
  std::string example() const override { return "boresight schema mechanism"; }
  std::vector<std::string> unused_options() const override {
    return {"--set", "--out", "--rung", "--accuracy", "--jobs", "--quiet", "--json"};
  }

  int execute(const Command& command) override {
    const std::vector<std::string> kinds = {"mechanism", "study"};
    if (std::find(kinds.begin(), kinds.end(), command.file) == kinds.end())
      throw InputError({"command line", 0}, "KIND", "\"" + command.file + "\"", "mechanism or study",
                       nearest_name(command.file, kinds));
    std::cout << json_schema(command.file).dump(2) << "\n";
    return kDone;
  }
};

}  // namespace

std::unique_ptr<Verb> make_schema_verb() { return std::make_unique<SchemaVerb>(); }

}  // namespace boresight::app
