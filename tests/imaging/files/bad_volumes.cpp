#include "bad_volumes.h"

#include <zlib.h>

#include <QElapsedTimer>
#include <cstring>

#include "imaging/files/volume_file.h"
#include "volumes.h"

namespace tidemark::test {

void add_rows(const std::vector<BadFile>& files) {
  QTest::addColumn<QString>("name");
  QTest::addColumn<QByteArray>("bytes");
  QTest::addColumn<QString>("field");
  for (const auto& file : files) {
    QTest::addRow("%s: %s", file.name, file.what)
        << QString(file.name) << QByteArray::fromStdString(file.bytes) << QString(file.field);
  }
  qInfo("%zu bad files", files.size());
}

void verify_volume_refused() {
  QFETCH(QString, name);
  QFETCH(QByteArray, bytes);
  QFETCH(QString, field);
  const TemporaryFolder folder;
  const auto path = folder / name.toStdString();
  put(path, bytes.toStdString());
  QElapsedTimer timer;
  timer.start();
  const auto volume = imaging::read_volume_file(path);
  QVERIFY2(timer.elapsed() < 1000, qPrintable(QString("%1 ms").arg(timer.elapsed())));
  QVERIFY(!volume);
  const QString message = QString::fromStdString(volume.error().message);
  qInfo("%s", qPrintable(message.mid(static_cast<int>(folder.path().string().size()) + 1)));
  QCOMPARE(volume.error().kind, ErrorKind::input);
  QVERIFY(message.startsWith(QString::fromStdString(folder.path().string())));
  QVERIFY2(message.contains(field), qPrintable(message));
  QVERIFY(!message.contains('\n'));
  // A scan gives no error, but never calls loadable what has a bad header.
  const auto series = imaging::scan_volume_file(path);
  QVERIFY(series);
  QCOMPARE(series->loadable, series->reason.empty());
}

std::string gzip(const std::string& bytes) {
  const TemporaryFolder folder;
  const gzFile file = gzopen((folder / "x").c_str(), "wb");
  gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
  gzclose(file);
  return contents(folder / "x");
}

std::string float_voxels(float bad) {
  std::string voxels(32, '\0');
  std::memcpy(voxels.data() + 20, &bad, 4);
  return voxels;
}

}  // namespace tidemark::test
