#include "ui/results/file_name.h"

#include <QRegularExpression>
#include <QStringList>
#include <algorithm>

#include "engine/study_loader.h"
#include "ui/widgets/path_text.h"

namespace tidemark::ui {
namespace {

// As one text, whether its characters are composed, and as wide as others.
QString comparable(const QString& text) {
  return text.normalized(QString::NormalizationForm_KC);
}

// Initials tell nothing. Names in scripts without capitals, as Chinese, may be as short.
bool tells(const QString& part) {
  constexpr qsizetype kInitials = 2;
  const auto characters = part.toUcs4();
  return part.size() > kInitials || std::any_of(characters.begin(), characters.end(), [](char32_t one) {
           return QChar::category(one) == QChar::Letter_Other;
         });
}

// Whether a part of the patient's name or number is in it.
bool tells_the_patient(const QString& text, const imaging::Patient& patient) {
  static const QRegularExpression kBetweenParts(QStringLiteral("[^\\w]+"),
                                                QRegularExpression::UseUnicodePropertiesOption);
  QStringList parts =
      comparable(QString::fromStdString(patient.name)).split(kBetweenParts, Qt::SkipEmptyParts);
  parts << comparable(QString::fromStdString(patient.id));
  const QString among = comparable(text);
  return std::any_of(parts.begin(), parts.end(), [&](const QString& part) {
    return tells(part) && among.contains(part, Qt::CaseInsensitive);
  });
}

}  // namespace

QString file_name_of(const QString& text) {
  static const QRegularExpression kNotInNames(QStringLiteral("[^\\w .()+-]"),
                                              QRegularExpression::UseUnicodePropertiesOption);
  constexpr int kLongest = 60;
  QString name = text;
  name.replace(kNotInNames, QStringLiteral("-"));
  // Not within a surrogate pair.
  if (name.size() > kLongest)
    name.truncate(name.at(kLongest - 1).isHighSurrogate() ? kLongest - 1 : kLongest);
  return name.simplified();
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
