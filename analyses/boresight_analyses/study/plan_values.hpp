// Values that the tables of several verbs have. Each throws InputError.
#pragma once

#include <cstdint>
#include <string>

#include "boresight/io/cursor.hpp"

namespace boresight {

double share_of(Cursor& table, const std::string& key, double otherwise);  // more than 0 and less than 1
std::uint64_t count_of(Cursor& table, const std::string& key, long long least, long long most, long long otherwise);
std::uint64_t seed_of(Cursor& table);  // key `seed`; 1 if left out

}  // namespace boresight
