// Every kind of phantom at full size: is it what it claims to be?
#include <QElapsedTimer>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <string>

#include "tests/imaging/phantom/measures.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::phantom_kinds_test {

class PhantomKindsTest : public QObject {
  Q_OBJECT

  // Some take seconds to make.
  const imaging::Phantom& usual(std::string_view kind) {
    const auto known = usual_.find(kind);
    return known != usual_.end() ? known->second : usual_.emplace(kind, made(kind, {}, 3)).first->second;
  }
  std::map<std::string, imaging::Phantom, std::less<>> usual_;

 private slots:
  void every_kind_is_there_data() {
    QTest::addColumn<QString>("kind");
    QTest::addColumn<Index3>("size");
    QTest::addColumn<qint64>("fewest");  // voxels of the truth
    QTest::addColumn<qint64>("most");
    QTest::addColumn<double>("in_range");  // the least share of them within T +- epsilon
    QTest::addColumn<quint64>("checksum");
    QTest::newRow("sphere") << "sphere" << Index3(81, 81, 81) << qint64{33'300} << qint64{33'700} << 0.99
                            << quint64{0xa09dff864f60d427};
    QTest::newRow("dumbbell") << "dumbbell" << Index3(121, 65, 65) << qint64{68'000} << qint64{71'000} << 0.99
                              << quint64{0xec867be46dc3d78f};
    QTest::newRow("bridge") << "bridge" << Index3(121, 65, 65) << qint64{33'300} << qint64{33'700} << 0.99
                            << quint64{0xbe6e93c6308e8fc7};
    QTest::newRow("tumour") << "tumour" << Index3(256, 256, 175) << qint64{114'000} << qint64{126'000} << 0.97
                            << quint64{0x119aea02d92c2ac4};
    QTest::newRow("cortex") << "cortex" << Index3(256, 256, 175) << qint64{1'250'000} << qint64{1'350'000}
                            << 0.94 << quint64{0x6789bfea08c8e2e6};
    QTest::newRow("organ") << "organ" << Index3(256, 256, 256) << qint64{1'000'000} << qint64{1'300'000}
                           << 0.96 << quint64{0xda4f37be4f6f8f46};
    QTest::newRow("junction") << "junction" << Index3(512, 512, 61) << qint64{350'000} << qint64{420'000}
                              << 0.75 << quint64{0x38c9f1b373d07d5d};
    QTest::newRow("head") << "head" << Index3(192, 224, 176) << qint64{650'000} << qint64{850'000} << 0.97
                          << quint64{0xb3984c2d8af00ba6};
  }

  void every_kind_is_there() {
    QFETCH(QString, kind);
    QFETCH(Index3, size);
    QFETCH(qint64, fewest);
    QFETCH(qint64, most);
    QFETCH(double, in_range);
    QFETCH(quint64, checksum);
    const imaging::Phantom phantom = made(kind.toStdString(), {}, 1);
    QVERIFY(phantom.volume.geometry.size == size);
    QVERIFY(phantom.truth.geometry == phantom.volume.geometry);
    QVERIFY(phantom.seed || phantom.init_threshold);

    const Contrast contrast = contrast_of(phantom);
    const QString figures = QString("%1 voxels, mean %2, %3 in range")
                                .arg(contrast.voxels)
                                .arg(contrast.mean)
                                .arg(contrast.in_range);
    QVERIFY2(contrast.voxels >= fewest && contrast.voxels <= most, qPrintable(figures));
    QVERIFY2(std::abs(contrast.mean - phantom.target) < phantom.range / 3.0, qPrintable(figures));
    QVERIFY2(contrast.in_range >= in_range, qPrintable(figures));
    QVERIFY(largest_part(phantom.truth) > 0.9999);

    // The same voxels for another number of threads, and on every machine.
    QVERIFY(stored(phantom) == stored(usual(kind.toStdString())));
    QCOMPARE(QString::number(tidemark::test::checksum(phantom), 16), QString::number(checksum, 16));
  }

  void a_seed_lies_in_what_is_to_be_found() {
    for (const std::string_view kind : imaging::phantom_kinds()) {
      const imaging::Phantom& phantom = usual(kind);
      if (!phantom.seed) continue;
      const auto& [i, j, k, radius_mm] = *phantom.seed;
      const Geometry& geometry = phantom.volume.geometry;
      const Index3 centre(i, j, k);
      // A seed of the sheet is wider than the sheet.
      const auto reach = kind == "cortex" ? 2 : static_cast<std::int64_t>(radius_mm / geometry.spacing_mm.x);
      for (std::int64_t z = -reach; z <= reach; ++z) {
        for (std::int64_t y = -reach; y <= reach; ++y) {
          for (std::int64_t x = -reach; x <= reach; ++x) {
            if (x * x + y * y + z * z > reach * reach) continue;
            const auto offset = static_cast<std::size_t>(geometry.offset(centre + Index3(x, y, z)));
            QVERIFY2(phantom.truth.voxels[offset] != 0, std::string(kind).c_str());
          }
        }
      }
    }
  }

  void the_sheet_of_cortex_is_4_to_6_voxels_thick() {
    const imaging::Phantom& cortex = usual("cortex");
    const std::map<int, std::int64_t> diameters = thickness(cortex.truth, 9, 7);
    std::int64_t all = 0;
    std::int64_t fitting = 0;
    for (const auto& [diameter, count] : diameters) {
      all += count;
      if (diameter >= 4 && diameter <= 6) fitting += count;
    }
    QVERIFY(all > 10'000);
    const double share = static_cast<double>(fitting) / static_cast<double>(all);
    QVERIFY2(share > 0.93, qPrintable(QString::number(share)));
  }

  void cortex_is_folded_and_ends_inside_the_volume() {
    const imaging::Phantom& cortex = usual("cortex");
    const Geometry& geometry = cortex.truth.geometry;
    // Faces between inside and outside, which a smooth sheet around the same ball would have 300,000 of.
    std::int64_t faces = 0;
    for (std::int64_t k = 0; k < geometry.size.z; ++k) {
      for (std::int64_t j = 0; j < geometry.size.y; ++j) {
        for (std::int64_t i = 0; i < geometry.size.x; ++i) {
          const bool here = cortex.truth.voxels[static_cast<std::size_t>(geometry.offset({i, j, k}))] != 0;
          const bool border = i == 0 || j == 0 || k == 0 || i + 1 == geometry.size.x ||
                              j + 1 == geometry.size.y || k + 1 == geometry.size.z;
          QVERIFY(!(here && border));
          if (border) continue;
          for (const Index3& next : {Index3(i + 1, j, k), Index3(i, j + 1, k), Index3(i, j, k + 1)}) {
            faces +=
                here != (cortex.truth.voxels[static_cast<std::size_t>(geometry.offset(next))] != 0) ? 1 : 0;
          }
        }
      }
    }
    QVERIFY2(faces > 550'000, qPrintable(QString::number(faces)));
  }

  void white_matter_keeps_its_place_in_the_range_under_noise() {
    for (const double noise : {0.0, 9.0}) {
      const imaging::Phantom head = made("head", {.noise_percent = noise, .random_seed = 2});
      const Contrast contrast = contrast_of(head);
      QVERIFY(std::abs(contrast.mean - head.target) < head.range / 3.0);
      QVERIFY(contrast.in_range > 0.75);
    }
  }

  void a_threshold_alone_leaks_out_of_the_organ() {
    const imaging::Phantom& organ = usual("organ");
    // What is in range and hangs together with the truth is far more than the truth.
    Mask in_range = organ.truth;
    const auto& values = stored(organ);
    for (std::size_t i = 0; i < values.size(); ++i) {
      in_range.voxels[i] = std::abs(values[i] - organ.target) < organ.range ? 1 : 0;
    }
    const double connected = largest_part(in_range) * static_cast<double>(in_range.count());
    QVERIFY2(connected > 1.15 * static_cast<double>(organ.truth.count()),
             qPrintable(QString::number(connected)));
  }
};

TIDEMARK_TEST(PhantomKindsTest)

}  // namespace tidemark::test::phantom_kinds_test

#include "phantom_kinds_test.moc"
