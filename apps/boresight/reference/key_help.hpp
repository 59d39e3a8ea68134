// `boresight help WORD`: the keys, tables and topics that a word names, as text for the terminal.
#pragma once

#include <string>
#include <vector>

namespace boresight::app {

// word: a key ("restitution"), a key's path ("clearance.contact.restitution", with names in it: "clearance.F1.contact.restitution"),
// a table ("clearance.friction", "friction") or a topic ("units"). "" where nothing is called so.
std::string key_help(const std::string& word);

// Everything that key_help() knows, for the nearest name.
std::vector<std::string> known_words();

// The table of a study that a verb reads; "" where it has none.
std::string keys_of_verb(const std::string& verb);

}  // namespace boresight::app
