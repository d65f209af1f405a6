// The folders of a user in which this program keeps files (XDG Base Directory Specification).
#pragma once

#include <filesystem>
#include <string>

#include "core/result.h"

namespace tidemark {

// $XDG_CONFIG_HOME/tidemark/NAME, else ~/.config/tidemark/NAME.
[[nodiscard]] std::filesystem::path user_configuration_file(const std::string& name);

// $XDG_STATE_HOME/tidemark, else ~/.local/state/tidemark: what is to outlive a program, and is no setting.
[[nodiscard]] std::filesystem::path user_state_folder();

// Makes a folder for its owner alone, and those above it where they are missing. Fails (ErrorKind::write)
// where it is somebody else's, or no folder.
[[nodiscard]] Status make_private_folder(const std::filesystem::path& folder);

}  // namespace tidemark
