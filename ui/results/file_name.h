// The names of a case's files unless the user gives others.
#pragma once

#include <QString>
#include <filesystem>

namespace tidemark::engine {
struct LoadedStudy;
}

namespace tidemark::ui {

// Without what has no place in names of files, and not too long.
QString file_name_of(const QString& text);
// The series' name without what has no place in names of files; its modality and date where the name tells
// who the patient is. Without an ending.
QString file_name_of(const engine::LoadedStudy& study);

// Such files are never written to.
[[nodiscard]] bool is_of_study(const engine::LoadedStudy& study, const std::filesystem::path& file);

}  // namespace tidemark::ui
