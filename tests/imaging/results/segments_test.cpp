// Segments out of label maps, and what their names say.
#include <QTest>

#include "tests/imaging/results/sample_results.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::segments_test {

class SegmentsTest : public QObject {
  Q_OBJECT

 private slots:
  void a_name_tells_what_it_is_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<QString>("word");
    const auto row = [](const char* name, const char* word) { QTest::newRow(name) << name << word; };
    row("Left kidney", "kidney");
    row("KIDNEYS", "kidney");
    row("vertebrae_L1", "vertebra");
    row("brain ventricle", "brain-ventricle");
    row("Brain", "brain");
    row("liver tumor", "tumour");
    row("Tumour of the liver", "tumour");
    row("Neoplasm, Secondary", "metastasis");
    row("CSF", "cerebrospinal-fluid");
    row("gray matter", "grey-matter");
    row("Label 1", "tissue");
    row("skullcap", "tissue");
    row("", "tissue");
    row("Leber \xc3\xa4", "tissue");
  }
  void a_name_tells_what_it_is() {
    QFETCH(QString, name);
    QFETCH(QString, word);
    QVERIFY(imaging::guess_segment_meaning(name.toStdString()) ==
            imaging::find_segment_meaning(word.toStdString()).value());
  }

  void every_meaning_is_found_by_its_word_and_by_its_code() {
    for (const imaging::NamedMeaning& named : imaging::segment_meanings()) {
      QVERIFY2(imaging::guess_segment_meaning(named.word) == named.meaning, std::string(named.word).c_str());
      QVERIFY2(imaging::guess_segment_meaning(named.meaning.type.meaning) == named.meaning,
               named.meaning.type.meaning.c_str());
    }
  }

  void each_number_of_a_label_map_is_a_segment() {
    Geometry grid;
    grid.size = {3, 2, 2};
    std::vector<float> values(12);
    values[1] = values[7] = 4.0F;
    values[11] = 255.0F;
    const auto segments = imaging::segments_of_numbers(grid, values, "labels.nii");
    QCOMPARE(failure(segments), QString());
    QCOMPARE(segments->list.size(), std::size_t{2});
    QCOMPARE(segments->list[0].name, std::string("Segment 4"));
    QCOMPARE(segments->list[0].count(), std::int64_t{2});
    QCOMPARE(segments->list[1].slices.begin()->first, std::int64_t{1});
    for (const float wrong : {-1.0F, 0.5F, 256.0F}) {
      values[0] = wrong;
      QVERIFY(failure(imaging::segments_of_numbers(grid, values, "labels.nii")).startsWith("labels.nii: "));
    }
    QVERIFY(failure(imaging::segments_of_numbers(grid, std::vector<float>(12), "none.nii"))
                .contains("holds no label"));
  }
};

TIDEMARK_TEST(SegmentsTest)

}  // namespace tidemark::test::segments_test

#include "segments_test.moc"
