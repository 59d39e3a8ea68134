// Options of verbs, declared without the headers of the library that reads the command line: every file that includes
// those takes a compiler six seconds longer.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace boresight::app {

// value: where the option's value lands. type: what --help calls it.
void declare_option(CLI::App& verb, const std::string& name, std::string& value, const std::string& description,
                    const std::string& type);
// --help says the value that it has where none is given, too.
void declare_option_with_default(CLI::App& verb, const std::string& name, std::string& value,
                                 const std::string& description, const std::string& type);
void declare_flag(CLI::App& verb, const std::string& name, bool& value, const std::string& description);

}  // namespace boresight::app
