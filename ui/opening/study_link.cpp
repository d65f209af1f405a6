#include "ui/opening/study_link.h"

#include <QDir>
#include <QRegularExpression>
#include <QUrl>
#include <QUrlQuery>

namespace tidemark::ui {
namespace {

const QString kScheme = QStringLiteral("tidemark");
constexpr qsizetype kLongestLink = 4096;

// IHE writes patientID, others patientid. Empty: it is not there.
QString parameter(const QUrl& link, const QString& name) {
  for (const auto& [key, value] : QUrlQuery(link).queryItems(QUrl::FullyDecoded)) {
    if (key.compare(name, Qt::CaseInsensitive) == 0) return value.trimmed();
  }
  return {};
}

// PS3.5 section 9.1.
bool is_uid(const QString& text) {
  static const QRegularExpression kUid(QStringLiteral("^[0-9]+(\\.[0-9]+)*$"));
  constexpr qsizetype kLongestUid = 64;
  return text.size() <= kLongestUid && kUid.match(text).hasMatch();
}

Result<StudyLink> file_link(const QUrl& url) {
  StudyLink link;
  link.path = parameter(url, "path");
  if (!QDir::isAbsolutePath(link.path))
    return fail(ErrorKind::usage, "the link's path is missing, or does not begin with /");
  return link;
}

Result<StudyLink> study_link(const QUrl& url, const QString& name) {
  StudyLink link;
  const QString uid = parameter(url, name);
  if (!is_uid(uid)) return fail(ErrorKind::usage, "the link's {} is missing, or no UID", name.toStdString());
  link.server = parameter(url, "server");
  link.query.uid = uid.toStdString();
  return link;
}

Result<StudyLink> patient_link(const QUrl& url) {
  StudyLink link;
  // HL7 writes the number before the authority that gave it: 4711^^^HOSPITAL.
  const QString id = parameter(url, "patientID").section(u'^', 0, 0);
  if (id.isEmpty()) return fail(ErrorKind::usage, "the link's patientID is missing");
  // A server would take these for any letters, and answer with other patients.
  if (id.contains(u'*') || id.contains(u'?'))
    return fail(ErrorKind::usage, "the link's patientID has a character that stands for others");
  link.server = parameter(url, "server");
  link.query.patient_id = id.toStdString();
  return link;
}

}  // namespace

bool StudyLink::is_link(const QString& text) {
  return text.startsWith(kScheme + u':', Qt::CaseInsensitive);
}

Result<StudyLink> StudyLink::parse(const QString& text) {
  const QUrl url(text, QUrl::StrictMode);
  if (!url.isValid() || text.size() > kLongestLink)
    return fail(ErrorKind::usage, "the link cannot be read, or is too long");
  const QString what = url.host().toLower();  // as Qt has it anyway
  if (what == u"open") return file_link(url);
  if (what == u"study") return study_link(url, "uid");
  if (what == u"iheinvokeimagedisplay") {
    const QString request = parameter(url, "requestType").toUpper();
    if (request == u"STUDY") return study_link(url, "studyUID");
    if (request == u"PATIENT") return patient_link(url);
    return fail(ErrorKind::usage, "the link's requestType is neither STUDY nor PATIENT");
  }
  return fail(ErrorKind::usage, "a link begins with {0}://open, {0}://study or {0}://IHEInvokeImageDisplay",
              kScheme.toStdString());
}

}  // namespace tidemark::ui
