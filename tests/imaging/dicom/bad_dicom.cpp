#include "tests/imaging/dicom/bad_dicom.h"

#include <QElapsedTimer>
#include <fstream>

#include "imaging/dicom/dicom.h"
#include "imaging/dicom/pixels.h"

namespace tidemark::test {
namespace {

constexpr qint64 kLongest = 1000;  // ms

void verify_message(const QString& message, const std::filesystem::path& file, const QString& field) {
  QVERIFY2(message.contains(QString::fromStdString(file.filename().string())), qPrintable(message));
  QVERIFY2(message.contains(field), qPrintable(message));
  QVERIFY2(!message.contains('\n'), qPrintable(message));
  QVERIFY2(message.size() < 400, qPrintable(message));
}

}  // namespace

void add_rows(const std::vector<BadDicom>& files) {
  QTest::addColumn<QByteArray>("bytes");
  QTest::addColumn<QString>("field");
  for (const BadDicom& file : files) {
    QTest::newRow(file.what.c_str()) << QByteArray::fromStdString(file.bytes)
                                     << QString::fromStdString(file.field);
  }
  qInfo("%zu bad files", files.size());
}

void verify_refused() {
  QFETCH(QByteArray, bytes);
  QFETCH(QString, field);
  const TemporaryFolder folder;
  const auto file = folder / "bad.dcm";
  std::ofstream(file, std::ios::binary).write(bytes.data(), bytes.size());

  QElapsedTimer timer;
  timer.start();
  const auto slice = imaging::decode_frame(file);
  QVERIFY2(timer.elapsed() < kLongest, qPrintable(QString("%1 ms").arg(timer.elapsed())));
  QVERIFY(!slice);
  QCOMPARE(slice.error().kind, ErrorKind::input);
  verify_message(QString::fromStdString(slice.error().message), file, field);

  timer.start();
  const auto found = imaging::scan_dicom(folder.path());
  QVERIFY2(timer.elapsed() < kLongest, qPrintable(QString("%1 ms").arg(timer.elapsed())));
  QCOMPARE(failure(found), QString());
  QCOMPARE(found->series.size() + found->skipped.size(), std::size_t{1});
  for (const imaging::Series& series : found->series) {
    // A frame is only looked at when it is read.
    QVERIFY(series.loadable ? !imaging::load_dicom(series) : !series.reason.empty());
  }
  for (const imaging::SkippedFile& skipped : found->skipped) QVERIFY(!skipped.reason.empty());
}

}  // namespace tidemark::test
