// Whose images they are stands in the corners of every view, until it is hidden.
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"
#include "ui/views/overlay.h"
#include "ui/views/slice_view.h"
#include "ui/views/volume_view.h"

namespace tidemark::test::corners_test {

namespace {

std::shared_ptr<const engine::LoadedStudy> ball_of(const std::string& patient, const std::string& date) {
  auto study = std::make_shared<engine::LoadedStudy>(*test::ball_study());
  study->patient = {patient, "PID-4711", "F", "45Y"};
  study->date = date;
  return study;
}

// The overlay alone: pictures arrive with events, of which the tests handle none.
std::unique_ptr<ui::PictureView> view_of(engine::CaseProxy& proxy, bool in_3d) {
  std::unique_ptr<ui::PictureView> view;
  if (in_3d) {
    view = std::make_unique<ui::VolumeViewWidget>(proxy);
  } else {
    view =
        std::make_unique<ui::SliceViewWidget>(proxy, ui::SlicePlane::axial, renderer::SliceContent::source);
  }
  view->resize(500, 400);
  view->show();
  return view;
}

int differing_pixels(const QImage& a, const QImage& b, const QRect& in) {
  int count = 0;
  for (int y = in.top(); y <= in.bottom(); ++y) {
    for (int x = in.left(); x <= in.right(); ++x) count += a.pixel(x, y) != b.pixel(x, y) ? 1 : 0;
  }
  return count;
}

}  // namespace

class CornersTest : public QObject {
  Q_OBJECT

 private slots:
  void patient_and_series_are_said_in_lines() {
    const auto study = ball_of("山田 太郎 (Yamada, Tarou)", "2004-07-31");
    QCOMPARE(ui::patient_lines(study->patient),
             QStringList({QString::fromUtf8("山田 太郎 (Yamada, Tarou)"), "PID-4711", "F 45Y"}));
    QCOMPARE(ui::series_lines(*study), QStringList({"2004-07-31", "Ball"}));
    QCOMPARE(ui::patient_lines({}), QStringList());
    QCOMPARE(ui::patient_lines({"Doe", "", "", "3D"}), QStringList({"Doe", "3D"}));
    QCOMPARE(ui::series_lines(*test::ball_study()), QStringList("Ball"));
  }

  void a_long_name_ends_before_the_next_corner() {
    QImage picture(300, 200, QImage::Format_RGB32);
    picture.fill(Qt::black);
    const QImage empty = picture;
    QPainter painter(&picture);
    ui::paint_corner(painter, picture.size(), Qt::AlignLeft | Qt::AlignTop, {QString(500, 'W')});
    painter.end();
    QVERIFY(differing_pixels(picture, empty, QRect(0, 0, 140, 200)) > 500);
    QCOMPARE(differing_pixels(picture, empty, QRect(142, 0, 158, 200)), 0);
  }

  // Right in the picture is the patient's left, up is the front.
  void every_edge_bears_the_letter_of_its_side() {
    const QSize size(400, 300);
    const auto painted = [size](const auto& paint) {
      QImage picture(size, QImage::Format_RGB32);
      picture.fill(Qt::black);
      QPainter painter(&picture);
      paint(painter);
      painter.end();
      return picture;
    };
    struct Edge {
      const char* letter;
      Qt::Alignment side;
      QRect in;
    };
    const std::vector<Edge> edges{
        {"L", Qt::AlignRight | Qt::AlignVCenter, QRect(340, 0, 60, 300)},
        {"R", Qt::AlignLeft | Qt::AlignVCenter, QRect(0, 0, 60, 300)},
        {"A", Qt::AlignTop | Qt::AlignHCenter, QRect(150, 0, 100, 60)},
        {"P", Qt::AlignBottom | Qt::AlignHCenter, QRect(150, 240, 100, 60)},
    };
    const QImage empty = painted([](QPainter& /*painter*/) {});
    for (const bool is_known : {true, false}) {
      const QImage all = painted([&](QPainter& painter) {
        ui::paint_orientation(painter, size, {1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, is_known);
      });
      for (const Edge& edge : edges) {
        const QImage alone = painted([&](QPainter& painter) {
          ui::paint_text(painter, QRectF(8, 8, 384, 284), static_cast<int>(edge.side),
                         is_known ? edge.letter : "?");
        });
        QVERIFY2(differing_pixels(alone, empty, edge.in) > 10, edge.letter);
        QVERIFY2(differing_pixels(all, alone, edge.in) == 0, edge.letter);
      }
    }
  }

  // WCAG 2.1: the contrast of text to what it stands on.
  void texts_are_read_on_the_brightest_tissue_data() {
    QTest::addColumn<int>("what");
    QTest::newRow("corner") << 0;
    QTest::newRow("orientation") << 1;
    QTest::newRow("scale bar") << 2;
  }

  void texts_are_read_on_the_brightest_tissue() {
    QFETCH(int, what);
    QImage picture(400, 300, QImage::Format_RGB32);
    picture.fill(Qt::white);
    QPainter painter(&picture);
    painter.setRenderHint(QPainter::Antialiasing);
    if (what == 0)
      ui::paint_corner(painter, picture.size(), Qt::AlignLeft | Qt::AlignTop, {"Doe, John", "4711"});
    if (what == 1) ui::paint_orientation(painter, picture.size(), {1.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, true);
    if (what == 2) ui::paint_scale_bar(painter, picture.size(), 0.5);
    painter.end();
    // What lies around the lightest pixels of text, which are not quite white: the commonest colour there.
    std::map<QRgb, int> around;
    const QRgb text = qRgb(240, 240, 240);
    for (int y = 3; y < picture.height() - 3; ++y) {
      for (int x = 3; x < picture.width() - 3; ++x) {
        if (picture.pixel(x, y) != text) continue;
        for (int dy = -3; dy <= 3; ++dy) {
          for (int dx = -3; dx <= 3; ++dx) ++around[picture.pixel(x + dx, y + dy)];
        }
      }
    }
    around.erase(text);
    QVERIFY(!around.empty());
    const QRgb ground = std::max_element(around.begin(), around.end(), [](const auto& a, const auto& b) {
                          return a.second < b.second;
                        })->first;
    const auto luminance = [](QRgb colour) {
      const double c = qGray(colour) / 255.0;
      return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    };
    const double contrast = (luminance(text) + 0.05) / (luminance(ground) + 0.05);
    QVERIFY2(contrast >= 4.5, qPrintable(QString::number(contrast)));
  }

  void a_low_view_has_room_for_the_name_alone() {
    engine::Engine engine{false};
    engine::CaseProxy proxy(engine, ball_of("Doe, John", "2004-07-31"), solver::ExecutorKind::host);
    engine::CaseProxy nameless(engine, ball_of("", ""), solver::ExecutorKind::host);
    QVERIFY(QTest::qWaitFor([&] { return engine.idle(); }, 60000));
    const auto view = view_of(proxy, false);
    const auto other = view_of(nameless, false);
    const int line = view->fontMetrics().height();
    view->resize(400, 7 * line);
    other->resize(400, 7 * line);
    const QImage low = view->grab_picture();
    other->proxy().display().change([](engine::DisplaySettings& settings) { settings.patient_text = false; });
    const QImage without = other->grab_picture();
    const int below_name = 8 + line + 2;
    QVERIFY(differing_pixels(low, without, QRect(0, 0, 190, below_name)) > 50);
    QCOMPARE(differing_pixels(low, without, QRect(0, below_name, 400, 7 * line - below_name)), 0);
    QCOMPARE(differing_pixels(low, without, QRect(200, 0, 200, 7 * line)), 0);
  }

  void every_view_names_the_patient_until_that_is_hidden_data() {
    QTest::addColumn<bool>("in_3d");
    QTest::newRow("slice") << false;
    QTest::newRow("3D") << true;
  }

  void every_view_names_the_patient_until_that_is_hidden() {
    QFETCH(bool, in_3d);
    engine::Engine engine{false};
    engine::CaseProxy one(engine, ball_of("Doe, John", "2004-07-31"), solver::ExecutorKind::host);
    engine::CaseProxy other(engine, ball_of("Mustermann, Erika", "2011-01-02"), solver::ExecutorKind::host);
    QVERIFY(QTest::qWaitFor([&] { return engine.idle(); }, 60000));
    const auto view = view_of(one, in_3d);
    const auto other_view = view_of(other, in_3d);
    const QImage shown = view->grab_picture();
    const QImage shown_other = other_view->grab_picture();
    const QRect upper_left(0, 0, 240, 100);
    const QRect upper_right(260, 0, 240, 100);
    QVERIFY(differing_pixels(shown, shown_other, upper_left) > 50);
    QVERIFY(differing_pixels(shown, shown_other, upper_right) > 20);
    for (engine::CaseProxy* proxy : {&one, &other})
      proxy->display().change([](engine::DisplaySettings& settings) { settings.patient_text = false; });
    const QImage hidden = view->grab_picture();
    QVERIFY(differing_pixels(shown, hidden, upper_left) > 50);
    QCOMPARE(differing_pixels(hidden, other_view->grab_picture(), hidden.rect()), 0);
  }

  // The outline of the state that is compared is in no view of pages.
  void a_colour_is_named_where_it_is_seen() {
    PanelCase the_case;
    the_case.begin();
    the_case.proxy->step();
    the_case.wait_until_idle();
    const std::uint64_t begun = the_case.state().history->back().state.id;
    for (const auto content : {renderer::SliceContent::source, renderer::SliceContent::pages}) {
      the_case.proxy->comparison().choose(std::nullopt);
      ui::SliceViewWidget view(*the_case.proxy, ui::SlicePlane::axial, content);
      view.resize(500, 400);
      view.show();
      const QImage before = view.grab_picture();
      the_case.proxy->comparison().choose(begun);
      QVERIFY(the_case.proxy->comparison().state());
      const bool is_same = differing_pixels(before, view.grab_picture(), before.rect()) == 0;
      QCOMPARE(is_same, content == renderer::SliceContent::pages);
    }
  }
};

TIDEMARK_TEST(CornersTest)

}  // namespace tidemark::test::corners_test

#include "corners_test.moc"
