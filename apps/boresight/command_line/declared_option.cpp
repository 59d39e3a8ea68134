#include "command_line/declared_option.hpp"

#include <CLI/CLI.hpp>

namespace boresight::app {

void declare_option(CLI::App& verb, const std::string& name, std::string& value, const std::string& description,
                    const std::string& type) {
  verb.add_option(name, value, description)->type_name(type);
}

void declare_option_with_default(CLI::App& verb, const std::string& name, std::string& value,
                                 const std::string& description, const std::string& type) {
  verb.add_option(name, value, description)->type_name(type)->capture_default_str();
}

void declare_flag(CLI::App& verb, const std::string& name, bool& value, const std::string& description) {
  verb.add_flag(name, value, description);
}

}  // namespace boresight::app
