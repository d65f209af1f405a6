// Names for GL objects in debug messages. Private to this folder.
#pragma once

#include <string_view>

#include "gpu/device.h"

namespace tidemark::gpu {

void set_label(const Device& device, unsigned kind, unsigned id, std::string_view label);

}  // namespace tidemark::gpu
