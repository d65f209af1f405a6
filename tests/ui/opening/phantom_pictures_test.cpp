// The pictures on the phantoms' cards show the phantoms as they are. Whoever changes a phantom looks at the
// new ones and writes them: TIDEMARK_WRITE_PICTURES=resources/phantoms.
#include <QImage>
#include <QPainter>
#include <cmath>
#include <cstdlib>

#include "engine/source_summary.h"
#include "engine/study_picture.h"
#include "imaging/phantom/phantom.h"
#include "tests/support/test_program.h"
#include "ui/views/mask_outline.h"

namespace tidemark::test::phantom_pictures_test {

namespace {

constexpr int kPixels = 112;  // two for one on a card

// The slice through the seed, with the truth's outline in the surface's yellow.
QImage picture_of(const imaging::Phantom& phantom) {
  const Geometry& geometry = phantom.volume.geometry;
  const std::int64_t k = phantom.seed ? std::llround((*phantom.seed)[2]) : geometry.size.z / 2;
  const WindowLevel window = engine::summarise(phantom.volume, {}).window;
  QImage picture =
      engine::picture_of_volume(phantom.volume, window, k, kPixels).convertToFormat(QImage::Format_RGB32);
  const glm::dvec3 first = geometry.to_patient({-0.5, -0.5, static_cast<double>(k)});
  const double scale = picture.width() / (static_cast<double>(geometry.size.x) * geometry.spacing_mm.x);
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(QColor(255, 217, 0), 1.6));
  const glm::dvec3 on_slice = geometry.to_patient({0.0, 0.0, static_cast<double>(k)});
  for (const QLineF& line : ui::outline_in_slice(BitMask(phantom.truth), renderer::kAxial, on_slice)) {
    // The patient's left is at the right, the back below.
    const auto place = [&](QPointF mm) {
      return QPointF((mm.x() - first.x) * scale, (-mm.y() - first.y) * scale);
    };
    painter.drawLine(place(line.p1()), place(line.p2()));
  }
  return picture;
}

double mean_difference(const QImage& a, const QImage& b) {
  double sum = 0.0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const QColor p = a.pixelColor(x, y);
      const QColor q = b.pixelColor(x, y);
      sum += std::abs(p.red() - q.red()) + std::abs(p.green() - q.green()) + std::abs(p.blue() - q.blue());
    }
  }
  return sum / (3.0 * a.width() * a.height());
}

}  // namespace

class PhantomPicturesTest : public QObject {
  Q_OBJECT

 private slots:
  void a_card_shows_its_phantom_data() {
    QTest::addColumn<QString>("kind");
    for (const std::string_view kind : imaging::phantom_kinds()) {
      const QString name = QString::fromUtf8(kind.data(), static_cast<qsizetype>(kind.size()));
      QTest::newRow(qPrintable(name)) << name;
    }
  }

  void a_card_shows_its_phantom() {
    QFETCH(QString, kind);
    const auto phantom = imaging::make_phantom(kind.toStdString());
    QVERIFY(phantom);
    QCOMPARE(phantom->volume.geometry.direction, glm::dmat3(1.0));
    const QImage now = picture_of(*phantom);
    const QString folder = qEnvironmentVariable("TIDEMARK_WRITE_PICTURES");
    if (!folder.isEmpty()) QVERIFY(now.save(folder + '/' + kind + ".png"));
    const QImage stored = folder.isEmpty() ? QImage(QStringLiteral(":/tidemark/phantoms/%1.png").arg(kind))
                                           : QImage(folder + '/' + kind + ".png");
    QCOMPARE(stored.size(), now.size());
    QVERIFY2(mean_difference(stored, now) < 2.0, qPrintable(QString::number(mean_difference(stored, now))));
  }
};

TIDEMARK_TEST(PhantomPicturesTest)

}  // namespace tidemark::test::phantom_pictures_test

#include "phantom_pictures_test.moc"
