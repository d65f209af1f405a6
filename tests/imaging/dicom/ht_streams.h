// A High-Throughput JPEG 2000 code stream (ISO 15444-15) of 12 bits, which nothing here can write: made by
// OpenJPH 0.21.2, without its comment marker. Bytes as hexadecimal digits.
#pragma once

#include <string_view>

namespace tidemark::test {

inline constexpr int kHtColumns = 12;
inline constexpr int kHtRows = 10;

inline constexpr std::string_view kHt12Bits =
    "ff4fff51002940000000000c0000000a00000000000000000000000c0000000a000000000000000000010b0101ff5000"
    "08000200000005ff52000c00020001000104044001ff5c00072068686868ff90000a00000000008a0001ff93c002ed80"
    "ff5fe7d37a91d366dfc335574a1c5022bce7dcb6fed9dfc8407b06b68fd68d58d1dfac8e4c78504ce700fb9f7fcb80e6"
    "0b0c8001bd00c002d48005af000ae0949afa877fc77474c3ff2018d85ea200f4815800ff7de77fff797f80b9f1518409"
    "f5d80b082ab4f483d900ff777fff6fff79dc11bb5cc3d700ffd9";

}  // namespace tidemark::test
