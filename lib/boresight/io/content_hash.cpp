#include "boresight/io/content_hash.hpp"

namespace boresight {

void ContentHash::mix(unsigned char byte) {
  constexpr Word kPrime = (Word{1} << 88) | 0x13b;  // FNV's 128-bit prime
  state_ ^= byte;
  state_ *= kPrime;
}

void ContentHash::add(std::string_view bytes) {
  for (const char c : bytes) mix(static_cast<unsigned char>(c));
  for (int shift = 0; shift < 64; shift += 8) mix(static_cast<unsigned char>(std::size_t{bytes.size()} >> shift));
}

std::string ContentHash::hexadecimal() const {
  static const char* const digits = "0123456789abcdef";
  std::string text;
  for (int shift = 124; shift >= 0; shift -= 4) text += digits[static_cast<unsigned>(state_ >> shift) & 0xf];
  return text;
}

}  // namespace boresight
