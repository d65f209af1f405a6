// Labels are finished by tools: chosen, looked at in slices, applied and undone, by mouse and keys.
#include <QAbstractButton>
#include <QApplication>
#include <QComboBox>
#include <QLabel>
#include <QMdiArea>
#include <QMdiSubWindow>
#include <QSignalSpy>
#include <QTableView>
#include <functional>

#include "engine/label_finisher.h"
#include "imaging/regions/margin.h"
#include "solver/inside_region.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "tests/ui/main/labels_desktop.h"
#include "tests/ui/main/results_desktop.h"
#include "ui/panels/labels_model.h"
#include "ui/widgets/number_box.h"

namespace tidemark::test::finish_labels_story_test {

namespace {

using IsInside = std::function<bool(Index3)>;

bool is_in_box(Index3 voxel, std::int64_t low, std::int64_t high) {
  return std::min({voxel.x, voxel.y, voxel.z}) >= low && std::max({voxel.x, voxel.y, voxel.z}) < high;
}
// A block with a bubble, and a small one apart.
bool is_block(Index3 voxel) {
  return is_in_box(voxel, 20, 50) && !is_in_box(voxel, 30, 33);
}
bool is_crumb(Index3 voxel) {
  return is_in_box(voxel, 60, 66);
}

Region region_where(const Geometry& grid, const IsInside& is_inside) {
  Region region(VoxelRange{Index3(0), grid.size});
  for (std::int64_t i = 0; i < grid.voxel_count(); ++i) {
    if (is_inside(grid.voxel_at(i))) region.add(grid.voxel_at(i));
  }
  return region;
}

}  // namespace

class FinishLabelsStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void a_label_grows_is_smoothed_and_split();
  void each_tool_finds_what_is_known();
  void smoothing_rounds_a_block();
  void a_label_is_combined_with_the_surface();
  void a_label_is_split_between_seeds();
  void a_tool_works_on_the_case_that_is_seen();
  void a_preview_follows_the_locks_of_labels();
  void a_preview_follows_the_cross_and_the_clip_plane();
  void each_tool_has_its_amount_after_any_other();
  void what_is_applied_is_the_amount_that_was_typed();
  void a_tool_waits_for_a_surface_that_moves();
  void each_case_keeps_its_chosen_label();

 private:
  static void wait_for_preview(Desktop& desktop, ui::LabelsPanel& panel) {
    QVERIFY(Desktop::wait_for([&] { return seen<QAbstractButton>(panel, "Apply to labels")->isEnabled(); }));
    QVERIFY(desktop.proxy().label_finisher().is_current());
    desktop.wait_until_idle();
  }
  static void type_amount(QWidget& panel, const QString& text) {
    auto* box = seen<ui::NumberBox>(panel, "Amount");
    QTest::mouseClick(box, Qt::LeftButton);
    box->selectAll();
    QTest::keyClicks(box, text);
    QTest::keyClick(box, Qt::Key_Tab);
  }
  // Chosen, looked at, applied; an empty amount leaves what the tool has.
  static void use_tool(Desktop& desktop, ui::LabelsPanel& panel, const QString& tool, const QString& amount) {
    Desktop::choose_in(panel, "Tool", tool);
    if (!amount.isEmpty()) type_amount(panel, amount);
    wait_for_preview(desktop, panel);
    desktop.screenshot(QString("finish-4-%1").arg(tool));
    click(desktop, panel, "Apply to labels");
  }
  // What a right click in a view's middle finds.
  static std::optional<glm::dvec3> place_in(ui::PictureView& view) {
    std::optional<std::optional<glm::dvec3>> found;
    const auto asked = connect(&view, &ui::PictureView::menu_wanted,
                               [&](QPoint, std::optional<glm::dvec3> place_mm) { found = place_mm; });
    QTest::mouseClick(&view, Qt::RightButton, {}, view.rect().center());
    Desktop::wait_for([&] { return found && QApplication::activePopupWidget() != nullptr; });
    if (QWidget* menu = QApplication::activePopupWidget()) menu->close();
    disconnect(asked);
    return found.value_or(std::nullopt);
  }
  // By the first label.
  static void paint(Desktop& desktop, const IsInside& is_inside) {
    desktop.proxy().brush_label({1, {}, region_where(desktop.proxy().volume().geometry, is_inside)},
                                document::Labels::Stroke::adds, document::Take::free_voxels);
    desktop.wait_until_idle();
  }
  static void undo(Desktop& desktop) {
    desktop.press(Qt::Key_Z, Qt::ControlModifier);
    desktop.wait_until_idle();
  }
  static void make_label(Desktop& desktop, ui::LabelsPanel& panel) {
    desktop.begin(8.0);
    click(desktop, panel, "Accept surface into label");
    QCOMPARE(desktop.state().labels.size(), std::size_t{1});
  }
};

void FinishLabelsStoryTest::a_label_grows_is_smoothed_and_split() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::LabelsPanel& panel = *shown_panel(desktop);
  make_label(desktop, panel);
  const Geometry& grid = desktop.proxy().volume().geometry;
  const Region before = region(desktop, 1);
  const QImage without = desktop.view<ui::SliceViewWidget>("Axial")->grab_picture();
  auto* solid = desktop.view<ui::VolumeViewWidget>();
  const QImage solid_before = solid->grab_picture();

  Desktop::choose_in(panel, "Tool", "Grow");
  type_amount(panel, "4,5");  // either separator is understood
  wait_for_preview(desktop, panel);
  desktop.screenshot("finish-0-grow");
  // Slices show it, and nothing is changed yet.
  QVERIFY(region(desktop, 1) == before);
  QVERIFY(difference(desktop.view<ui::SliceViewWidget>("Axial")->grab_picture(), without) > 0.0005);
  const QImage solid_preview = solid->grab_picture();
  QVERIFY(difference(solid_preview, solid_before) > 0.01);
  // A click there means what is seen: the ball that has grown, where the surface does not shine through.
  for (const auto& [opacity, radius_mm] : {std::pair(0.4, 8.0), {1.0, 12.5}}) {
    desktop.proxy().display().change(
        [shown = opacity](engine::DisplaySettings& settings) { settings.label_opacity = shown; });
    const auto place = place_in(*solid);
    QVERIFY(place);
    QVERIFY(std::abs(glm::distance(*place, desktop.seed_mm()) - radius_mm) < 1.0);
  }
  desktop.proxy().display().change([](engine::DisplaySettings& settings) { settings.label_opacity = 0.4; });
  const Region wanted = imaging::grown(before, grid, 4.5).value();
  QVERIFY(desktop.proxy().label_finisher().preview()->regions.front().region == wanted);
  click(desktop, panel, "Apply to labels");
  QVERIFY(region(desktop, 1) == wanted);
  QVERIFY(!desktop.proxy().label_finisher().preview());
  QCOMPARE(desktop.state().undo_text, QString("finishing of Label 1"));
  // 3D has shown what has come of it.
  QVERIFY(difference(solid->grab_picture(), solid_preview) < 0.0005);
  desktop.screenshot("finish-1-grown");

  Desktop::choose_in(panel, "Tool", "Split at the clip plane");
  wait_for_preview(desktop, panel);
  desktop.screenshot("finish-2-split");
  click(desktop, panel, "Apply to labels");
  QCOMPARE(desktop.state().labels.size(), std::size_t{2});
  QVERIFY(tidemark::united(region(desktop, 1), region(desktop, 2)) == wanted);
  undo(desktop);
  undo(desktop);
  QVERIFY(region(desktop, 1) == before);
  QCOMPARE(desktop.state().labels.size(), std::size_t{1});
  QVERIFY(difference(solid->grab_picture(), solid_before) < 0.0005);

  // What cannot be done is said, and nothing is applied.
  Desktop::choose_in(panel, "Tool", "Fill between slices");
  QVERIFY(Desktop::wait_for([&] {
    for (QLabel* label : panel.findChildren<QLabel*>()) {
      if (label->isVisible() && label->text().contains("no empty slice")) return true;
    }
    return false;
  }));
  QVERIFY(!seen<QAbstractButton>(panel, "Apply to labels")->isEnabled());
  desktop.screenshot("finish-3-refused");
  // It is not tried again with each step of the surface, but where labels have changed.
  const QSignalSpy refusals(&desktop.proxy().label_finisher(), &engine::JobRunner::failed);
  const std::int64_t steps = desktop.state().step;
  for (int i = 0; i < 3; ++i) {
    desktop.press(Qt::Key_Period);
    desktop.wait_until_idle();
    QTest::qWait(500);
  }
  QVERIFY(desktop.state().step > steps);
  QCOMPARE(refusals.size(), 0);
  document::Label renamed = desktop.state().labels.front();
  renamed.name = "Organ";
  desktop.proxy().set_label(renamed);
  QVERIFY(Desktop::wait_for([&] { return refusals.size() == 1; }));
}

void FinishLabelsStoryTest::each_tool_finds_what_is_known() {
  const IsInside both = [](Index3 v) { return is_block(v) || is_crumb(v); };
  const IsInside filled = [](Index3 v) { return is_in_box(v, 20, 50) || is_crumb(v); };
  const IsInside shrunk = [](Index3 v) { return is_in_box(v, 22, 48) || is_in_box(v, 62, 64); };
  const IsInside mirrored = [&](Index3 v) { return both({v.x, v.y, 80 - v.z}); };
  const IsInside drawn = [](Index3 v) { return is_in_box(v, 20, 50) && v.z % 4 == 0; };
  const IsInside between = [](Index3 v) { return is_in_box(v, 20, 50) && v.z < 49; };
  struct Use {
    const char* tool;
    const char* amount;
    IsInside before;
    IsInside after;
  };
  const Use uses[] = {{"Keep the largest island", "", both, is_block},
                      {"Keep the island under the cross", "", both, is_crumb},
                      {"Remove small islands", "0.3", both, is_block},
                      {"Fill holes", "", both, filled},
                      {"Fill holes in slices", "", both, filled},
                      {"Shrink", "2", filled, shrunk},
                      {"Mirror", "", both, mirrored},
                      {"Fill between slices", "", drawn, between}};
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::LabelsPanel& panel = *shown_panel(desktop);
  const Geometry& grid = desktop.proxy().volume().geometry;
  QCOMPARE(grid.size, Index3(81));
  desktop.proxy().display().change([&](engine::DisplaySettings& settings) {
    settings.cursor_mm = grid.to_patient({63.0, 63.0, 63.0});
  });
  click(desktop, panel, "Add");
  for (const Use& use : uses) {
    paint(desktop, use.before);
    use_tool(desktop, panel, use.tool, use.amount);
    QVERIFY2(region(desktop, 1) == region_where(grid, use.after), use.tool);
    undo(desktop);
    QVERIFY2(region(desktop, 1) == region_where(grid, use.before), use.tool);
    Desktop::choose_in(panel, "Tool", "None");
    undo(desktop);
  }
}

void FinishLabelsStoryTest::smoothing_rounds_a_block() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::LabelsPanel& panel = *shown_panel(desktop);
  click(desktop, panel, "Add");
  paint(desktop, is_block);
  const Region before = region(desktop, 1);
  for (const char* tool : {"Smooth by the median", "Smooth and keep the volume"}) {
    use_tool(desktop, panel, tool, "2.5");
    const Region smooth = region(desktop, 1);
    for (const std::int64_t corner : {20, 49}) QVERIFY2(!smooth.contains(Index3(corner)), tool);
    QVERIFY2(smooth.contains({20, 35, 35}) && smooth.contains({35, 35, 49}), tool);  // middles of faces
    const double kept = static_cast<double>(smooth.count()) / static_cast<double>(before.count());
    // Voxels of a face are alike, and come or go together.
    QVERIFY2(kept > 0.95 && kept < 1.03, qPrintable(QString("%1: %2").arg(tool).arg(kept)));
    undo(desktop);
    QVERIFY2(region(desktop, 1) == before, tool);
  }
}

void FinishLabelsStoryTest::a_label_is_combined_with_the_surface() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::LabelsPanel& panel = *shown_panel(desktop);
  desktop.begin(16.0);
  click(desktop, panel, "Add");
  paint(desktop, is_block);
  const Region before = region(desktop, 1);
  const Region ball = solver::inside_region(*desktop.state().phi);
  for (const auto& [tool, wanted] : {std::pair("Add", tidemark::united(before, ball)),
                                     {"Subtract", tidemark::difference(before, ball)},
                                     {"Intersect", tidemark::intersection(before, ball)}}) {
    use_tool(desktop, panel, tool, {});
    QVERIFY2(region(desktop, 1) == wanted && !(wanted == before), tool);
    undo(desktop);
    QVERIFY2(region(desktop, 1) == before, tool);
  }
}

// Two discs that touch, as organs do that were taken for one.
void FinishLabelsStoryTest::a_label_is_split_between_seeds() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::LabelsPanel& panel = *shown_panel(desktop);
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  const glm::dvec3 left = desktop.seed_mm() - glm::dvec3(12.0, 0.0, 0.0);
  const glm::dvec3 right = desktop.seed_mm() + glm::dvec3(12.0, 0.0, 0.0);
  const auto paint = [&](double radius_mm) {
    desktop.proxy().display().change(
        [&](engine::DisplaySettings& settings) { settings.brush_mm = radius_mm; });
    for (const glm::dvec3& place : {left, right}) {
      desktop.drag(*axial, {place});
      desktop.wait_until_idle();
    }
  };
  click(desktop, panel, "Brush");
  paint(14.0);
  const Region both = region(desktop, 1);
  Desktop::choose_in(panel, "Tool", "Split at necks");
  QVERIFY(Desktop::wait_for([&] { return says(panel, "Add another label and paint the seeds with it."); }));
  click(desktop, panel, "Add");
  click(desktop, panel, "Take voxels of other labels");
  paint(3.0);
  QVERIFY(region(desktop, 2).count() > 0);
  auto* table = seen<QTableView>(panel, "Labels");
  QTest::mouseClick(table->viewport(), Qt::LeftButton, {},
                    table->visualRect(table->model()->index(0, ui::LabelsModel::name)).center());
  wait_for_preview(desktop, panel);
  QCOMPARE(seen<QComboBox>(panel, "With")->currentText(), QString("Label 2"));
  desktop.screenshot("finish-3-necks");
  click(desktop, panel, "Apply to labels");
  QCOMPARE(desktop.state().labels.size(), std::size_t{3});
  QCOMPARE(desktop.state().labels.back().name, std::string("Label 1 2"));
  QVERIFY(region(desktop, 2).empty());
  QVERIFY(tidemark::united(region(desktop, 1), region(desktop, 3)) == both);
  const Geometry& grid = desktop.proxy().volume().geometry;
  const auto voxel_of = [&](glm::dvec3 place) { return Index3(glm::round(grid.to_voxel(place))); };
  QVERIFY(region(desktop, 1).contains(voxel_of(left)) != region(desktop, 1).contains(voxel_of(right)));
  QVERIFY(std::abs(region(desktop, 1).count() - region(desktop, 3).count()) < both.count() / 10);
}

void FinishLabelsStoryTest::a_tool_works_on_the_case_that_is_seen() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::LabelsPanel& panel = *shown_panel(desktop);
  make_label(desktop, panel);
  auto* first = desktop.window().active_case();
  Desktop::choose_in(panel, "Tool", "Shrink");
  wait_for_preview(desktop, panel);
  // Another case: the tool is put away, and the first case's preview with it.
  QVERIFY(desktop.open_phantom("dumbbell"));
  desktop.wait_until_idle();
  QCOMPARE(seen<QComboBox>(panel, "Tool")->currentText(), QString("None"));
  QVERIFY(!first->proxy().label_finisher().preview());
  QVERIFY(!desktop.proxy().label_finisher().preview());
}

void FinishLabelsStoryTest::a_preview_follows_the_locks_of_labels() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::LabelsPanel& panel = *shown_panel(desktop);
  make_label(desktop, panel);
  const auto lock = [&](bool locked) {
    document::Label label = desktop.state().labels.front();
    label.locked = locked;
    desktop.proxy().set_label(label);
    desktop.wait_until_idle();
  };
  Desktop::choose_in(panel, "Tool", "Grow");
  wait_for_preview(desktop, panel);
  auto* apply = seen<QAbstractButton>(panel, "Apply to labels");
  lock(true);
  QVERIFY(Desktop::wait_for([&] { return says(panel, "is locked"); }));
  QVERIFY(!apply->isEnabled());
  lock(false);
  wait_for_preview(desktop, panel);
  // An amount below a voxel changes nothing, and is not applied.
  type_amount(panel, "0.3");
  QVERIFY(Desktop::wait_for([&] { return says(panel, "It would change nothing."); }));
  QVERIFY(!apply->isEnabled());
}

void FinishLabelsStoryTest::a_preview_follows_the_cross_and_the_clip_plane() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::LabelsPanel& panel = *shown_panel(desktop);
  const Geometry& grid = desktop.proxy().volume().geometry;
  engine::LabelFinisher& finisher = desktop.proxy().label_finisher();
  const auto put_cross = [&](double voxel) {
    desktop.proxy().display().change(
        [&](engine::DisplaySettings& settings) { settings.cursor_mm = grid.to_patient(glm::dvec3(voxel)); });
  };
  const auto cut_at = [&](double voxel) {
    desktop.proxy().display().change([&](engine::DisplaySettings& settings) {
      settings.clip.normal = {1.0, 0.0, 0.0};
      settings.clip.offset_mm = grid.to_patient(glm::dvec3(voxel)).x;
    });
  };
  const auto keeps = [&](const IsInside& is_inside) {
    const Region wanted = region_where(grid, is_inside);
    return Desktop::wait_for([&] {
      return finisher.is_current() && finisher.preview()->regions.front().region == wanted &&
             seen<QAbstractButton>(panel, "Apply to labels")->isEnabled();
    });
  };
  click(desktop, panel, "Add");
  paint(desktop, [](Index3 v) { return is_block(v) || is_crumb(v); });

  put_cross(63.0);
  Desktop::choose_in(panel, "Tool", "Keep the island under the cross");
  QVERIFY(keeps(is_crumb));
  put_cross(25.0);
  QVERIFY(keeps(is_block));
  click(desktop, panel, "Apply to labels");
  QVERIFY(region(desktop, 1) == region_where(grid, is_block));

  cut_at(29.5);
  Desktop::choose_in(panel, "Tool", "Split at the clip plane");
  QVERIFY(keeps([](Index3 v) { return is_block(v) && v.x >= 30; }));
  cut_at(39.5);
  QVERIFY(keeps([](Index3 v) { return is_block(v) && v.x >= 40; }));

  // To other tools they make no difference.
  Desktop::choose_in(panel, "Tool", "Shrink");
  wait_for_preview(desktop, panel);
  const QSignalSpy previews(&finisher, &engine::LabelFinisher::changed);
  put_cross(40.0);
  cut_at(20.5);
  QTest::qWait(500);
  QCOMPARE(previews.size(), 0);
}

void FinishLabelsStoryTest::each_tool_has_its_amount_after_any_other() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::LabelsPanel& panel = *shown_panel(desktop);
  make_label(desktop, panel);
  desktop.begin(6.0);
  for (const char* before : {"Intersect", "Shrink"}) {
    use_tool(desktop, panel, before, {});
    Desktop::choose_in(panel, "Tool", "Grow");
    const auto* amount = find_seen<ui::NumberBox>(panel, "Amount");
    QVERIFY2(amount, before);
    QCOMPARE(amount->height(), amount->sizeHint().height());
    const auto* apply = seen<QAbstractButton>(panel, "Apply to labels");
    QVERIFY(Desktop::wait_for(
        [&] { return !apply->visibleRegion().isEmpty(); }));  // and not below the panel's end
    Desktop::choose_in(panel, "Tool", "None");
  }
}

// The press on the button ends the typing.
void FinishLabelsStoryTest::what_is_applied_is_the_amount_that_was_typed() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::LabelsPanel& panel = *shown_panel(desktop);
  make_label(desktop, panel);
  const Region before = region(desktop, 1);
  Desktop::choose_in(panel, "Tool", "Grow");
  wait_for_preview(desktop, panel);
  desktop.window().activateWindow();
  QVERIFY(QTest::qWaitForWindowActive(&desktop.window()));
  auto* box = seen<ui::NumberBox>(panel, "Amount");
  QTest::mouseClick(box, Qt::LeftButton);
  QVERIFY(box->hasFocus());
  box->selectAll();
  QTest::keyClicks(box, "5");
  auto* apply = seen<QAbstractButton>(panel, "Apply to labels");
  QVERIFY(apply->isEnabled());
  QTest::mouseClick(apply, Qt::LeftButton, {}, {8, apply->height() / 2});
  QVERIFY(!apply->isEnabled());
  QCOMPARE(box->value(), 5.0);
  desktop.wait_until_idle();
  QVERIFY(region(desktop, 1) == before);
  wait_for_preview(desktop, panel);
  click(desktop, panel, "Apply to labels");
  QVERIFY(region(desktop, 1) == imaging::grown(before, desktop.proxy().volume().geometry, 5.0).value());
}

void FinishLabelsStoryTest::a_tool_waits_for_a_surface_that_moves() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::LabelsPanel& panel = *shown_panel(desktop);
  make_label(desktop, panel);
  const Region before = region(desktop, 1);
  desktop.proxy().set_pause_at_convergence(false);
  desktop.press(Qt::Key_P);
  Desktop::choose_in(panel, "Tool", "Add");
  QVERIFY(Desktop::wait_for([&] { return says(panel, "Pause the surface"); }));
  auto* apply = seen<QAbstractButton>(panel, "Apply to labels");
  QVERIFY(desktop.state().playing);
  QVERIFY(!apply->isEnabled());
  desktop.press(Qt::Key_P);
  wait_for_preview(desktop, panel);
  const Region wanted = tidemark::united(before, solver::inside_region(*desktop.state().phi));
  QVERIFY(!(wanted == before));
  click(desktop, panel, "Apply to labels");
  QVERIFY(region(desktop, 1) == wanted);
}

void FinishLabelsStoryTest::each_case_keeps_its_chosen_label() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  auto* first = desktop.window().active_case();
  ui::LabelsPanel& panel = *shown_panel(desktop);
  for (int i = 0; i < 3; ++i) click(desktop, panel, "Add");
  auto* table = panel.findChild<QTableView*>();
  const auto click_row = [&](int row) {
    QTest::mouseClick(table->viewport(), Qt::LeftButton, {},
                      table->visualRect(table->model()->index(row, ui::LabelsModel::volume)).center());
    desktop.wait_until_idle();
  };
  const auto row = [&] { return table->selectionModel()->selectedRows().value(0).row(); };
  click_row(1);
  seen<QAbstractButton>(panel, "Take voxels of other labels")->click();
  auto* second = desktop.open_phantom("dumbbell");
  for (int i = 0; i < 3; ++i) click(desktop, panel, "Add");
  QVERIFY(!seen<QAbstractButton>(panel, "Take voxels of other labels")->isChecked());
  click_row(0);
  for (auto* window : {first, second, first}) {
    desktop.window().findChild<QMdiArea*>()->setActiveSubWindow(
        qobject_cast<QMdiSubWindow*>(window->parentWidget()));
    desktop.wait_until_idle();
    QCOMPARE(row(), window == first ? 1 : 0);
    QCOMPARE(window->proxy().chosen_label(), &window->proxy().state().labels[window == first ? 1 : 0]);
    QCOMPARE(seen<QAbstractButton>(panel, "Take voxels of other labels")->isChecked(), window == first);
  }
}

TIDEMARK_TEST(FinishLabelsStoryTest)

}  // namespace tidemark::test::finish_labels_story_test

#include "finish_labels_story_test.moc"
