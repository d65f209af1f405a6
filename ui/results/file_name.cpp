#include "ui/results/file_name.h"

#include <QRegularExpression>
#include <QStringList>
#include <algorithm>

#include "engine/study_loader.h"
#include "ui/widgets/path_text.h"

namespace tidemark::ui {
namespace {

// Whether a part of the patient's name or number is in it; initials say nothing.
bool tells_the_patient(const QString& text, const imaging::Patient& patient) {
  static const QRegularExpression kBetweenParts(QStringLiteral("[^\\w]+"),
                                                QRegularExpression::UseUnicodePropertiesOption);
  constexpr qsizetype kInitials = 2;
  QStringList parts = QString::fromStdString(patient.name).split(kBetweenParts, Qt::SkipEmptyParts);
  parts << QString::fromStdString(patient.id);
  return std::any_of(parts.begin(), parts.end(), [&](const QString& part) {
    return part.size() > kInitials && text.contains(part, Qt::CaseInsensitive);
  });
}

}  // namespace

QString file_name_of(const QString& text) {
  static const QRegularExpression kNotInNames(QStringLiteral("[^\\w .()+-]"),
                                              QRegularExpression::UseUnicodePropertiesOption);
  constexpr int kLongest = 60;
  return text.left(kLongest).replace(kNotInNames, QStringLiteral("-")).simplified();
}

QString file_name_of(const engine::LoadedStudy& study) {
  static const QRegularExpression kEnding(
      QStringLiteral("\\.(nii|gipl|nrrd|nhdr|mha|mhd|dcm|png|jpe?g|tiff?)(\\.gz)?$"),
      QRegularExpression::CaseInsensitiveOption);
  QString name = study.name;
  const bool is_phantom = !study.origin.phantom.empty();
  if (!is_phantom && tells_the_patient(name, study.patient)) {
    name = QString::fromStdString(study.volume->modality + " " + study.date);
  }
  return file_name_of(name.remove(kEnding));
}

bool is_of_study(const engine::LoadedStudy& study, const std::filesystem::path& file) {
  const auto is_it = [&](const std::filesystem::path& other) { return is_same_file(file, other); };
  return is_it(study.origin.path) || std::any_of(study.dicom_files.begin(), study.dicom_files.end(), is_it);
}

}  // namespace tidemark::ui
