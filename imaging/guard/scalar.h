// The types of numbers in volume files.
#pragma once

#include <array>
#include <cstddef>

namespace tidemark::imaging::files {

enum class Scalar { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

constexpr const char* name_of(Scalar type) {
  constexpr std::array kNames{"int8",   "uint8", "int16",  "uint16",  "int32",
                              "uint32", "int64", "uint64", "float32", "float64"};
  return kNames[static_cast<std::size_t>(type)];
}

constexpr int bytes_of(Scalar type) {
  constexpr std::array kBytes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kBytes[static_cast<std::size_t>(type)];
}

}  // namespace tidemark::imaging::files
