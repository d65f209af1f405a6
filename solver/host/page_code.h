// The byte that a page writes after a step, from which pages are allocated and freed (paper section 4.4).
#pragma once

#include <cstdint>

namespace tidemark::solver {

inline constexpr std::uint8_t kRequestBits = 0x3f;  // one a face: the page across it is needed
inline constexpr std::uint8_t kReleaseBit = 0x40;   // has been constant for a while
inline constexpr std::uint8_t kMovedBit = 0x80;     // moved, so that its neighbours must be awake

constexpr std::uint8_t request_bit(int face) {
  return static_cast<std::uint8_t>(1U << static_cast<unsigned>(face));
}

}  // namespace tidemark::solver
