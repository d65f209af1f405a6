// High-Throughput JPEG 2000 code streams (ISO 15444-15), which nothing here can write: made by OpenJPH 0.21.2
// of the picture that ht_value() tells, without its comment marker. Bytes as hexadecimal digits.
#pragma once

#include <cstdint>
#include <string_view>

namespace tidemark::test {

inline constexpr int kHtColumns = 12;
inline constexpr int kHtRows = 10;

constexpr std::int32_t ht_value(int column, int row, int bits) {
  return bits == 12 ? (column * 331 + row * 97 + column * row * 7) % 4096
                    : (column * 3310 + row * 977 + column * row * 71) % 65536;
}

inline constexpr std::string_view kHt12Bits =
    "ff4fff51002940000000000c0000000a00000000000000000000000c0000000a000000000000000000010b0101ff5000"
    "08000200000005ff52000c00020001000104044001ff5c00072068686868ff90000a00000000008a0001ff93c002ed80"
    "ff5fe7d37a91d366dfc335574a1c5022bce7dcb6fed9dfc8407b06b68fd68d58d1dfac8e4c78504ce700fb9f7fcb80e6"
    "0b0c8001bd00c002d48005af000ae0949afa877fc77474c3ff2018d85ea200f4815800ff7de77fff797f80b9f1518409"
    "f5d80b082ab4f483d900ff777fff6fff79dc11bb5cc3d700ffd9";
inline constexpr std::string_view kHt16Bits =
    "ff4fff51002940000000000c0000000a00000000000000000000000c0000000a000000000000000000010f0101ff5000"
    "08000200000009ff52000c00020001000104044001ff5c00072088888888ff90000a0000000000860001ff93c0002f43"
    "ff7fbbf047cccbba47cc36e19abceefc88fbd821c18ebbf08cf453eaf4e5243ed7fdc74d8cae01a58bcab7c70e824f08"
    "49c734859cec6e04fed9e505d02e420051bc00c0002d080005a3000098da69af12ecd2b8f9d8e2daaa73827800a0c78b"
    "d849af100cd5f430de6301beb8008cfa00807500ffd9";
// With loss: a quantization step of 0.001 of the 12 bits.
inline constexpr std::string_view kHtLossy12Bits =
    "ff4fff51002940000000000c0000000a00000000000000000000000c0000000a000000000000000000010b0101ff5000"
    "08000200000024ff52000c00020001000104044000ff5c000b225856581a581a67bfff90000a00000000009e0001ff93"
    "c00bb221efb99e3b34eaddc09a976abb4353710bb5dd6935100887a736dc31f54c10b939443de30ffe27f67fcb80e50b"
    "086001bc00c00ba08016ec005aa026caf09a506a488b2163e39591e580bcf302f400023fe9708637e301c00b7f002a1a"
    "8202e0e9928b2286b6388632191950d00592d9dc65b2c625ea3b006128b1252279b530ae106813feb5923c34e40cc800"
    "ffd9";

}  // namespace tidemark::test
