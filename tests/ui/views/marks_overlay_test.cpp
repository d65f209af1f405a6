// Marks lie on their voxels in slices of every orientation, and kinds are told apart without colour.
#include "ui/views/marks_overlay.h"

#include <QImage>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/stroke_painting.h"
#include "tests/support/test_program.h"

namespace tidemark::test::marks_overlay_test {

namespace {

const Geometry kGrid{{40, 36, 30}, {1.0, 1.5, 2.0}, glm::dmat3(1.0), {-8.0, 12.0, 5.0}};

double area_of(const QPainterPath& path) {
  double twice = 0.0;
  for (const QPolygonF& polygon : path.toSubpathPolygons()) {
    for (qsizetype i = 0; i + 1 < polygon.size(); ++i)
      twice += polygon[i].x() * polygon[i + 1].y() - polygon[i + 1].x() * polygon[i].y();
  }
  return std::abs(0.5 * twice);
}

QPointF on_slice(const renderer::SliceOrientation& orientation, glm::dvec3 mm) {
  return {glm::dot(mm, orientation.right), glm::dot(mm, orientation.up)};
}

}  // namespace

class MarksOverlayTest : public QObject {
  Q_OBJECT

 private slots:
  void an_area_covers_its_voxels_data() {
    QTest::addColumn<int>("plane");
    QTest::newRow("axial") << 0;
    QTest::newRow("coronal") << 1;
    QTest::newRow("sagittal") << 2;
  }

  void an_area_covers_its_voxels() {
    QFETCH(int, plane);
    const renderer::SliceOrientation orientation =
        plane == 0 ? renderer::kAxial : (plane == 1 ? renderer::kCoronal : renderer::kSagittal);
    const glm::dvec3 centre = kGrid.to_patient({20.0, 18.0, 15.0});
    const engine::SliceSlab slab(kGrid, centre, orientation.into());
    const auto voxels = slab.disc(centre, 6.0);
    QVERIFY(voxels.size() > 30);
    const ui::MarkedArea marked = ui::area_in_slice(kGrid, slab, orientation, voxels);
    const double cell_mm2 = plane == 0 ? 1.0 * 1.5 : (plane == 1 ? 1.0 * 2.0 : 1.5 * 2.0);
    QVERIFY(std::abs(area_of(marked.area) - static_cast<double>(voxels.size()) * cell_mm2) < 1e-6);
    for (const std::int64_t offset : voxels) {
      const Index3 voxel = kGrid.voxel_at(offset);
      const QPointF place = on_slice(orientation, kGrid.to_patient(glm::dvec3(voxel)));
      QVERIFY(marked.area.contains(place));
    }
    // The border is around it: its lines are as far from the middle as the disc's voxels end.
    QVERIFY(marked.border.size() >= 20);
    const QPointF middle = on_slice(orientation, centre);
    for (const QLineF& line : marked.border) {
      const double away = QLineF(middle, line.center()).length();
      QVERIFY2(away > 4.0 && away < 7.5, qPrintable(QString::number(away)));
    }
  }

  void other_slices_have_nothing_of_it() {
    const glm::dvec3 centre = kGrid.to_patient({20.0, 18.0, 15.0});
    const engine::SliceSlab slab(kGrid, centre, renderer::kAxial.into());
    const auto voxels = slab.disc(centre, 6.0);
    const engine::SliceSlab next(kGrid, kGrid.to_patient({20.0, 18.0, 16.0}), renderer::kAxial.into());
    QVERIFY(ui::area_in_slice(kGrid, next, renderer::kAxial, voxels).area.isEmpty());
    // Across it they are a line one voxel high.
    const engine::SliceSlab across(kGrid, centre, renderer::kCoronal.into());
    const auto marked = ui::area_in_slice(kGrid, across, renderer::kCoronal, voxels);
    QVERIFY(std::abs(marked.area.boundingRect().height() - 2.0) < 1e-9);
  }

  // In grey, as a print or the eye of a colour-blind person has it.
  void kinds_differ_by_their_filling() {
    const auto share_covered = [](const engine::DrawnMarks& marks) {
      const glm::dvec3 centre = kGrid.to_patient({20.0, 18.0, 15.0});
      renderer::SliceView view;
      view.orientation = renderer::kAxial;
      view.position_mm = centre;
      const ui::SliceScreen screen(view, {400.0, 400.0}, kGrid);
      QImage image(400, 400, QImage::Format_RGB32);
      image.fill(Qt::black);
      QPainter painter(&image);
      ui::MarksOverlay overlay;
      overlay.paint(painter, marks, kGrid, renderer::kAxial, centre, screen);
      painter.end();
      // In the middle, away from the border.
      const QPoint at = screen.position_of(centre).toPoint();
      int covered = 0;
      for (int y = -16; y < 16; ++y) {
        for (int x = -16; x < 16; ++x) covered += qGray(image.pixel(at + QPoint(x, y))) > 20 ? 1 : 0;
      }
      return covered / (32.0 * 32.0);
    };
    const glm::dvec3 centre = kGrid.to_patient({20.0, 18.0, 15.0});
    const auto voxels = engine::SliceSlab(kGrid, centre, renderer::kAxial.into()).disc(centre, 8.0);
    auto walls = std::make_shared<solver::Constraints>(kGrid.size);
    walls->set(kGrid, {centre, 8.0}, solver::Constraint::wall);
    auto anchors = std::make_shared<solver::Constraints>(kGrid.size);
    anchors->set(kGrid, {centre, 8.0}, solver::Constraint::anchor);
    const double inside = share_covered({engine::painted(nullptr, voxels, engine::Mark::inside), nullptr});
    const double outside = share_covered({engine::painted(nullptr, voxels, engine::Mark::outside), nullptr});
    const double wall = share_covered({nullptr, walls});
    const double anchor = share_covered({nullptr, anchors});
    qInfo("covered: inside %.2f, outside %.2f, walls %.2f, anchors %.2f", inside, outside, wall, anchor);
    QCOMPARE(inside, 1.0);
    QVERIFY(outside > 0.05 && outside < 0.3);
    QVERIFY(wall > 1.5 * outside && wall < 0.5);
    QVERIFY(anchor > 0.02 && anchor < 0.3);
    QCOMPARE(share_covered({}), 0.0);
  }
};

TIDEMARK_TEST(MarksOverlayTest)

}  // namespace tidemark::test::marks_overlay_test

#include "marks_overlay_test.moc"
