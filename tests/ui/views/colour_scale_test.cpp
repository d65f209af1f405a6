// Legends of colours.
#include "ui/views/colour_scale.h"

#include "document/sweep_picture.h"
#include "tests/support/test_program.h"

namespace tidemark::test::colour_scale_test {

class ColourScaleTest : public QObject {
  Q_OBJECT

 private slots:
  // A voxel has the colour of its share of the runs.
  void an_agreement_begins_with_the_colour_of_one_run() {
    for (const int runs : {1, 2, 4, 8}) {
      const ui::ColourScale scale = ui::scale_of_agreement(runs);
      const auto colour_of = [&](int count) {
        const auto [red, green, blue] = document::heat_colour(static_cast<double>(count) / runs);
        return QColor(red, green, blue);
      };
      QCOMPARE(scale.low, QString("1"));
      QCOMPARE(scale.colours.first(), colour_of(1));
      QCOMPARE(scale.high, QString::number(runs));
      QCOMPARE(scale.colours.last(), colour_of(runs));
    }
  }
};

TIDEMARK_TEST(ColourScaleTest)

}  // namespace tidemark::test::colour_scale_test

#include "colour_scale_test.moc"
