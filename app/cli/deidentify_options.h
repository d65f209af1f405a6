// The options of a de-identification, and what is told of one.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/console.h"
#include "imaging/deidentify/deidentify.h"

namespace tidemark::cli {

void add_deidentify_options(CLI::App& command, imaging::DeidentifyOptions& options);

// Lines for people and, on standard error, what was left out and what may show who it is.
void say_deidentified(Console& console, const imaging::Deidentified& result,
                      const imaging::DeidentifyOptions& options);

// The same for scripts.
[[nodiscard]] Json deidentified_json(const imaging::Deidentified& result,
                                     const imaging::DeidentifyOptions& options);

// Fails (ErrorKind::input) where files were left out that are neither documents nor something else than
// DICOM.
[[nodiscard]] Status require_complete(const imaging::Deidentified& result);

}  // namespace tidemark::cli
