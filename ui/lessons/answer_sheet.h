// The answers to a lesson as a page to be printed or handed in.
#pragma once

#include <filesystem>

#include "core/result.h"
#include "document/lesson_answers.h"

namespace tidemark::ui {

// Writes a PDF of A4 pages. On any thread. Fails (ErrorKind::write).
Status write_answer_sheet(const document::Lesson& lesson, const document::LessonAnswers& answers,
                          const std::filesystem::path& file);

}  // namespace tidemark::ui
