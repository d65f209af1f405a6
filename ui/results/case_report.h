// The report of a case for people: its regions with their measures, how they came to be, and pictures.
#pragma once

#include <QImage>
#include <QList>
#include <QString>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/progress.h"
#include "document/measures.h"
#include "document/session_contents.h"
#include "engine/measurement.h"
#include "imaging/patient.h"

namespace tidemark::ui {

// What a report takes from a case beside its contents.
struct ReportSource {
  QString study;
  QString date;                                         // of the study; empty: not known
  std::optional<imaging::Patient> patient;              // none: the report does not name the patient
  std::shared_ptr<const Volume> volume;                 // whose values are measured
  std::vector<engine::Measurement> measurements;        // complete ones
  std::vector<std::pair<QString, QString>> parameters;  // names and values: what drove the surface
  std::vector<std::pair<QString, QImage>> pictures;     // titles and pictures
};

// Rich text for both forms, with the pictures in it. On any thread; the surface and each label are measured.
// Fails as document::measure() does.
Result<QString> report_page(const ReportSource& source, const document::SessionContents& contents);

// A PDF file by its suffix, else HTML that needs no other file. Fails as report_page() does, and
// (ErrorKind::write).
Status write_report(const ReportSource& source, const document::SessionContents& contents,
                    const std::filesystem::path& file);

}  // namespace tidemark::ui
