// A fingerprint of an input, kept with its results: equal bytes give equal hashes on every machine and in every version.
// FNV-1a, 128 bits (Fowler, Noll, Vo; draft-eastlake-fnv). It tells inputs apart; it is no protection against forgery.
#pragma once

#include <string>
#include <string_view>

namespace boresight {

class ContentHash {
 public:
  // Adds bytes, and their number, so that ("ab", "c") and ("a", "bc") differ.
  void add(std::string_view bytes);
  // 32 hexadecimal digits.
  std::string hexadecimal() const;

 private:
  __extension__ using Word = unsigned __int128;
  void mix(unsigned char byte);
  Word state_ = (Word{0x6c62272e07bb0142ULL} << 64) | 0x62b821756295c58dULL;  // FNV's offset basis
};

}  // namespace boresight
