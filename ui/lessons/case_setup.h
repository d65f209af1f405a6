// The setting of an open case, for a lesson: its start, its parameters, and how far it has run.
#pragma once

#include <QString>
#include <cstdint>
#include <filesystem>
#include <functional>

#include "document/lesson.h"
#include "document/origin.h"
#include "engine/case_proxy.h"

namespace tidemark::ui {

struct CaseSetup {
  document::StudyOrigin origin;
  document::Start start;          // empty: the case has no surface yet
  document::Start phantoms_own;   // empty: the study is no phantom
  solver::Parameters parameters;  // the present ones
  double smoothed_mm = 0.0;
  std::int64_t steps = 0;   // since the start
  bool is_plain = true;     // the tent alone drives it, and nothing holds it
  bool was_edited = false;  // on its way: painted, or other parameters

  // Whether the case is on that study; noise does not matter. `folder` is that of the lesson's file.
  [[nodiscard]] bool is_on(const document::LessonStudy& study, const std::filesystem::path& folder) const;
};

// The answer comes later, or never when the case is closed before.
void take_setup(engine::CaseProxy& proxy, std::function<void(const CaseSetup&)> answer,
                std::function<void()> gave_up);

// Both return what could not be taken over, in sentences; empty: all was.
// The try of a part: parameters, smoothing and steps, and the start where it does not go on.
QString put_into_part(const CaseSetup& setup, document::Lesson& lesson, std::size_t part,
                      const std::filesystem::path& folder);
// The lesson's study, start and parameters. Those of the parts follow where they were the same.
QString put_into_lesson(const CaseSetup& setup, document::Lesson& lesson,
                        const std::filesystem::path& folder);

}  // namespace tidemark::ui
