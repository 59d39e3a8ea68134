// A file that another one names: what is wrong with it is told with the place that names it.
#pragma once

#include <string>
#include <utility>

#include "boresight/mechanism/error.hpp"

namespace boresight {

// Calls read(), which reads `file`. A fault of the file as such (not there, a folder, too large) becomes one of the key that names
// it; a fault inside it keeps its own line and says who named the file. Faults of other files and of settings pass as they are.
// where, key: of the text that names the file.
template <typename Read>
auto read_referred(const Origin& where, const std::string& key, const std::string& file, const Read& read) {
  try {
    return read();
  } catch (const InputError& fault) {
    if (fault.origin.file != file) throw;
    if (fault.origin.line == 0 && fault.key.empty())
      throw InputError(where, key, "\"" + file + "\", " + fault.found, fault.expected, fault.nearest);
    const std::string named = where.file + (where.line > 0 ? ":" + std::to_string(where.line) : "");
    throw InputError(fault.origin, fault.key, fault.found,
                     fault.expected + " (" + key + " in " + named + " names this file)", fault.nearest);
  }
}

}  // namespace boresight
