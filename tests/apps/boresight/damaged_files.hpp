// Files of the corpus with one fault in them, for what judges files: a key left out, or unknown; another type; no unit; a number that
// is negative, zero or huge; a list that is empty, or too short, or too long.
#pragma once

#include <functional>
#include <string>

#include "boresight/io/document.hpp"

namespace boresight::app {

struct Damage {
  std::string at;    // "montecarlo.requirement.limit"; of tables of one name the same for each
  std::string what;  // "a text in place of a number"
  // No other value of the file could make this one legal: the type is wrong, or the key unknown.
  bool by_itself = false;
};

// Calls `judge` with every damaged file that can be made of this one.
void for_each_damage(Node root, const std::function<void(const Damage&, const Node& damaged)>& judge);

// As a file; the order is kept.
std::string toml_of(const Node& root);

}  // namespace boresight::app
