// A document for people as a PDF file.
#pragma once

#include <QString>
#include <filesystem>

#include "core/result.h"

namespace tidemark::ui {

// By the suffix, case ignored.
[[nodiscard]] bool is_pdf_name(const std::filesystem::path& file);

// A4 pages of rich text (HTML as QTextDocument knows it). On any thread. Fails (ErrorKind::write).
Status write_pdf_file(const QString& html, const QString& title, const std::filesystem::path& file);

}  // namespace tidemark::ui
