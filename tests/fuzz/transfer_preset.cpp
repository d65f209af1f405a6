// A transfer-function preset.
#include <cstdlib>
#include <string_view>

#include "renderer/transfer_function.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using tidemark::renderer::TransferFunction;
  const auto function =
      tidemark::renderer::TransferFunction::parse({reinterpret_cast<const char*>(bytes), count});
  if (!function) return 0;
  const auto again = tidemark::renderer::TransferFunction::parse(function->to_json());
  if (!again || !(*again == *function)) std::abort();
  return 0;
}
