#include "ui/panels/labels_panel.h"

#include <QAbstractButton>
#include <QCheckBox>
#include <QColorDialog>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPointer>
#include <QPushButton>
#include <QSignalSpy>
#include <QTableView>
#include <QToolButton>

#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"
#include "ui/panels/labels_model.h"
#include "ui/panels/meaning_picker.h"

namespace tidemark::test::labels_panel_test {

class LabelsPanelTest : public QObject {
  Q_OBJECT
 private slots:
  void init() {
    the_case_ = std::make_unique<PanelCase>();
    panel_ = shown<ui::LabelsPanel>(*the_case_, 500);
  }
  void cleanup() {
    panel_.reset();
    the_case_.reset();
  }

  void a_new_label_is_the_chosen_one() {
    add();
    add();
    QCOMPARE(the_case_->state().labels.size(), std::size_t{2});
    QCOMPARE(chosen_row(), 1);
    QVERIFY(the_case_->state().labels[0].name != the_case_->state().labels[1].name);
    QVERIFY(the_case_->state().labels[0].colour != the_case_->state().labels[1].colour);
  }

  void the_surface_is_accepted_into_the_chosen_label() {
    add();
    QVERIFY(!button<QPushButton>(*panel_, tr("Accept surface into label"))->isEnabled());  // no surface
    the_case_->begin(8.0);
    click(tr("Accept surface into label"));
    const auto& statistics = the_case_->state().label_statistics;
    QCOMPARE(statistics.front().voxels, the_case_->state().surface.voxels_inside);
    const QString shown = text(0, ui::LabelsModel::volume);
    QCOMPARE(shown, QLocale().toString(statistics.front().volume_ml, 'f', 1));
    QVERIFY(shown != QLocale().toString(0.0, 'f', 1));
  }

  // The label that was accepted stays chosen, and the next structure must not take its place.
  void the_next_structure_does_not_replace_the_label_that_is_chosen() {
    the_case_->begin(5.0);
    click(tr("Accept surface into label"));
    const std::int64_t first = the_case_->state().label_statistics[0].voxels;
    document::Start start;
    start.seeds.push_back({the_case_->middle() + glm::dvec3(11.0, 0.0, 0.0), 4.0});
    the_case_->proxy->begin(start);
    the_case_->wait_until_idle();
    QCOMPARE(chosen_row(), 0);
    click(tr("Accept surface into label"));
    QCOMPARE(the_case_->state().labels.size(), std::size_t{2});
    QCOMPARE(the_case_->state().label_statistics[0].voxels, first);
    QVERIFY(the_case_->state().label_statistics[1].voxels > 100);
    QCOMPARE(chosen_row(), 1);
    QVERIFY(says("Label 1 has no voxel in common"));
  }

  void voxels_of_other_labels_are_taken_only_when_it_is_asked_for() {
    add();
    the_case_->begin(8.0);
    click(tr("Accept surface into label"));
    const std::int64_t all = the_case_->state().surface.voxels_inside;
    add();
    click(tr("Accept surface into label"));
    QCOMPARE(the_case_->state().label_statistics[0].voxels, all);
    QCOMPARE(the_case_->state().label_statistics[1].voxels, std::int64_t{0});
    QVERIFY(says(QString::number(all) + " voxels stayed"));
    auto* take_all = panel_->findChild<QCheckBox*>();
    QVERIFY(take_all && !take_all->isChecked());
    take_all->click();
    click(tr("Accept surface into label"));
    QCOMPARE(the_case_->state().label_statistics[0].voxels, std::int64_t{0});
    QCOMPARE(the_case_->state().label_statistics[1].voxels, all);
    QVERIFY(says(QString::number(all) + " of them had another label"));
    the_case_->proxy->undo();
    the_case_->wait_until_idle();
    QVERIFY(!says("voxels"));
    QCOMPARE(the_case_->state().label_statistics[0].voxels, all);
  }

  void without_a_label_the_surface_becomes_a_new_one() {
    QVERIFY(!button<QPushButton>(*panel_, tr("Accept surface into label"))->isEnabled());  // no surface
    the_case_->begin(8.0);
    click(tr("Accept surface into label"));
    QCOMPARE(the_case_->state().labels.size(), std::size_t{1});
    QCOMPARE(the_case_->state().label_statistics.front().voxels, the_case_->state().surface.voxels_inside);
    QCOMPARE(chosen_row(), 0);
    // Again it goes into that one.
    click(tr("Accept surface into label"));
    QCOMPARE(the_case_->state().labels.size(), std::size_t{1});
  }

  void the_level_set_starts_again_from_a_label() {
    add();
    the_case_->begin(8.0);
    click(tr("Accept surface into label"));
    const auto voxels = the_case_->state().surface.voxels_inside;
    the_case_->begin(3.0);
    QVERIFY(the_case_->state().surface.voxels_inside != voxels);
    click(tr("Place surface from label"));
    QCOMPARE(the_case_->state().surface.voxels_inside, voxels);
  }

  void a_name_is_edited_in_the_table() {
    add();
    auto& table = *panel_->findChild<QTableView*>();
    table.setCurrentIndex(table.model()->index(0, ui::LabelsModel::name));
    table.setFocus();
    QTest::keyClick(&table, Qt::Key_F2);
    auto* editor = table.viewport()->findChild<QLineEdit*>();
    QVERIFY(editor);
    editor->selectAll();
    QTest::keyClicks(editor, "Left kidney");
    QTest::keyClick(editor, Qt::Key_Return);
    the_case_->wait_until_idle();
    QCOMPARE(QString::fromStdString(the_case_->state().labels.front().name), QStringLiteral("Left kidney"));
    QCOMPARE(text(0, ui::LabelsModel::name), QStringLiteral("Left kidney"));
  }

  void a_name_can_be_typed_while_the_surface_moves() {
    add();
    auto& table = *panel_->findChild<QTableView*>();
    table.setCurrentIndex(table.model()->index(0, ui::LabelsModel::name));
    table.setFocus();
    QTest::keyClick(&table, Qt::Key_F2);
    const QPointer<QLineEdit> editor = table.viewport()->findChild<QLineEdit*>();
    QVERIFY(editor);
    editor->selectAll();
    QTest::keyClicks(editor, "Left kid");
    the_case_->begin(5.0);
    the_case_->proxy->step(3);
    the_case_->wait_until_idle();
    QVERIFY(editor);
    QTest::keyClicks(editor, "ney");
    QTest::keyClick(editor, Qt::Key_Return);
    the_case_->wait_until_idle();
    QCOMPARE(QString::fromStdString(the_case_->state().labels.front().name), QStringLiteral("Left kidney"));
  }

  void boxes_show_and_lock_a_label_and_a_locked_one_takes_no_surface() {
    add();
    the_case_->begin(5.0);
    auto& table = *panel_->findChild<QTableView*>();
    tick(table, ui::LabelsModel::visible);
    tick(table, ui::LabelsModel::locked);
    the_case_->wait_until_idle();
    QVERIFY(!the_case_->state().labels.front().visible);
    QVERIFY(the_case_->state().labels.front().locked);
    QVERIFY(!button<QPushButton>(*panel_, tr("Accept surface into label"))->isEnabled());
    QVERIFY(!button<QAbstractButton>(*panel_, tr("Remove"))->isEnabled());
  }

  void two_edits_before_the_engine_answers_are_both_kept() {
    add();
    auto& model = *panel_->findChild<ui::LabelsModel*>();
    model.setData(model.index(0, ui::LabelsModel::locked), Qt::Checked, Qt::CheckStateRole);
    model.setData(model.index(0, ui::LabelsModel::name), QStringLiteral("Spleen"), Qt::EditRole);
    the_case_->wait_until_idle();
    QVERIFY(the_case_->state().labels.front().locked);
    QCOMPARE(the_case_->state().labels.front().name, std::string("Spleen"));
  }

  void an_empty_name_is_refused() {
    add();
    auto& model = *panel_->findChild<ui::LabelsModel*>();
    QVERIFY(!model.setData(model.index(0, ui::LabelsModel::name), QStringLiteral("  "), Qt::EditRole));
  }

  void a_colour_is_chosen_in_a_dialog_that_blocks_nothing() {
    add();
    QColorDialog* dialog = ask_for_colour();
    QVERIFY(dialog);
    dialog->setCurrentColor(QColor(10, 200, 30));
    dialog->accept();
    the_case_->wait_until_idle();
    QCOMPARE(the_case_->state().labels.front().colour, (std::array<std::uint8_t, 3>{10, 200, 30}));
  }

  void a_colour_that_is_being_chosen_is_for_no_other_case() {
    add();
    PanelCase other;
    other.proxy->add_label(QStringLiteral("Tumour"));  // with the same number
    other.wait_until_idle();
    QCOMPARE(other.state().labels.front().id, the_case_->state().labels.front().id);
    const QPointer<QColorDialog> dialog = ask_for_colour();
    QVERIFY(dialog && dialog->isVisible());
    panel_->set_proxy(other.proxy.get());
    QTRY_VERIFY(!dialog);
    panel_->set_proxy(nullptr);
  }

  void a_colour_is_not_chosen_for_a_case_that_has_closed() {
    add();
    const QPointer<QColorDialog> dialog = ask_for_colour();
    QVERIFY(dialog && dialog->isVisible());
    the_case_->proxy.reset();
    QTRY_VERIFY(!dialog);
  }

  void a_label_means_what_its_name_says_until_it_is_told() {
    add();
    auto& model = *panel_->findChild<ui::LabelsModel*>();
    model.setData(model.index(0, ui::LabelsModel::name), QStringLiteral("Left kidney"), Qt::EditRole);
    the_case_->wait_until_idle();
    auto& picker = *panel_->findChild<ui::MeaningPicker*>();
    QCOMPARE(picker.currentText(), QStringLiteral("By its name: Kidney"));
    QVERIFY(!the_case_->state().labels.front().meaning);
    picker.setFocus();
    picker.lineEdit()->selectAll();
    QTest::keyClicks(&picker, "cys");
    QTest::keyClick(&picker, Qt::Key_Return);
    the_case_->wait_until_idle();
    QVERIFY(the_case_->state().labels.front().meaning == imaging::find_segment_meaning("cyst").value());
    QCOMPARE(picker.currentText(), QStringLiteral("Cyst"));
    the_case_->proxy->undo();
    the_case_->wait_until_idle();
    QVERIFY(!the_case_->state().labels.front().meaning);
    QCOMPARE(picker.currentText(), QStringLiteral("By its name: Kidney"));
  }

  void a_meaning_of_another_system_is_kept_and_can_be_changed() {
    add();
    document::Label label = the_case_->state().labels.front();
    label.meaning = imaging::SegmentMeaning{{"1", "99X", "Thing"}, {"2", "99X", "Left gizmo"}};
    the_case_->proxy->set_label(label);
    the_case_->wait_until_idle();
    auto& picker = *panel_->findChild<ui::MeaningPicker*>();
    QCOMPARE(picker.currentText(), QStringLiteral("Left gizmo"));
    const int rows = picker.count();
    picker.setFocus();
    QTest::keyClick(&picker, Qt::Key_Up);
    the_case_->wait_until_idle();
    QCOMPARE(picker.currentText(), QStringLiteral("White matter"));
    QVERIFY(the_case_->state().labels.front().meaning ==
            imaging::find_segment_meaning("white-matter").value());
    the_case_->proxy->undo();
    the_case_->wait_until_idle();
    QVERIFY(the_case_->state().labels.front().meaning == label.meaning);
    QCOMPARE(picker.currentText(), QStringLiteral("Left gizmo"));
    QCOMPARE(picker.count(), rows);
  }

  void what_was_typed_and_means_nothing_goes() {
    add();
    auto& picker = *panel_->findChild<ui::MeaningPicker*>();
    const QString before = picker.currentText();
    picker.setFocus();
    picker.lineEdit()->selectAll();
    QTest::keyClicks(&picker, "zzz");
    QTest::keyClick(&picker, Qt::Key_Return);
    panel_->findChild<QTableView*>()->setFocus();
    the_case_->wait_until_idle();
    QCOMPARE(picker.currentText(), before);
    QVERIFY(!the_case_->state().labels.front().meaning);
  }

  void a_removed_label_leaves_the_others_and_one_of_them_chosen() {
    add();
    add();
    const auto kept = the_case_->state().labels.front().id;
    QTest::mouseClick(button<QToolButton>(*panel_, tr("Remove")), Qt::LeftButton);
    the_case_->wait_until_idle();
    QCOMPARE(the_case_->state().labels.size(), std::size_t{1});
    QCOMPARE(the_case_->state().labels.front().id, kept);
    QCOMPARE(chosen_row(), 0);
  }

  void a_label_added_elsewhere_shows() {
    the_case_->proxy->add_label(QStringLiteral("Tumour"));
    the_case_->wait_until_idle();
    QCOMPARE(text(0, ui::LabelsModel::name), QStringLiteral("Tumour"));
  }

  void labels_to_choose_from_stay_while_they_are_the_same() {
    add();
    add();
    auto* tool = named<QComboBox>(*panel_, tr("Tool"));
    tool->setCurrentText(tr("Add"));
    emit tool->activated(tool->currentIndex());
    the_case_->wait_until_idle();
    auto* with = named<QComboBox>(*panel_, tr("With"));
    QCOMPARE(with->count(), 2);  // the surface, and the label that is not chosen
    const QSignalSpy taken(with->model(), &QAbstractItemModel::rowsRemoved);
    const QSignalSpy made_anew(with->model(), &QAbstractItemModel::modelReset);
    const QSignalSpy added(with->model(), &QAbstractItemModel::rowsInserted);
    the_case_->proxy->display().change([](engine::DisplaySettings& s) { s.cursor_mm.x += 3.0; });
    the_case_->begin(8.0);
    QCOMPARE(taken.size() + made_anew.size() + added.size(), 0);
    const int last = with->count() - 1;
    with->setCurrentIndex(last);
    document::Label other = the_case_->state().labels.front();
    QCOMPARE(with->currentData().toInt(), int{other.id});
    other.name = "Spleen";
    the_case_->proxy->set_label(other);
    the_case_->wait_until_idle();
    QCOMPARE(with->currentText(), QStringLiteral("Spleen"));
    QCOMPARE(with->count(), 2);
  }

  void opacity_is_that_of_the_slices() {
    auto* opacity = named<QDoubleSpinBox>(*panel_, tr("Opacity"));
    opacity->setFocus();
    opacity->selectAll();
    QTest::keyClicks(opacity, "75");
    QTest::keyClick(opacity, Qt::Key_Return);
    QCOMPARE(the_case_->proxy->display().settings().label_opacity, 0.75);
  }

  void without_a_session_the_table_is_empty() {
    add();
    the_case_->proxy.reset();
    QCOMPARE(panel_->findChild<ui::LabelsModel*>()->rowCount(), 0);
    QVERIFY(!panel_->findChild<QTableView*>()->isEnabled());
  }

 private:
  // By a click on the colour of the first label.
  QColorDialog* ask_for_colour() {
    auto& table = *panel_->findChild<QTableView*>();
    const QModelIndex cell = table.model()->index(0, ui::LabelsModel::colour);
    QTest::mouseClick(table.viewport(), Qt::LeftButton, {}, table.visualRect(cell).center());
    return panel_->findChild<QColorDialog*>();
  }
  void add() {
    QTest::mouseClick(button<QToolButton>(*panel_, tr("Add")), Qt::LeftButton);
    the_case_->wait_until_idle();
  }
  void click(const QString& text) {
    auto* one = button<QPushButton>(*panel_, text);
    QVERIFY(one->isEnabled());
    QTest::mouseClick(one, Qt::LeftButton);
    the_case_->wait_until_idle();
  }
  // Whether a sentence that is seen has this in it.
  bool says(const QString& words) {
    const auto labels = panel_->findChildren<QLabel*>();
    return std::any_of(labels.begin(), labels.end(), [&](const QLabel* label) {
      return label->isVisible() && label->text().contains(words);
    });
  }
  static void tick(QTableView& table, int column) {
    const QModelIndex cell = table.model()->index(0, column);
    table.setCurrentIndex(cell);
    table.setFocus();
    QTest::keyClick(&table, Qt::Key_Space);
  }
  QString text(int row, int column) {
    const auto& model = *panel_->findChild<ui::LabelsModel*>();
    return model.data(model.index(row, column), Qt::DisplayRole).toString();
  }
  int chosen_row() {
    const auto rows = panel_->findChild<QTableView*>()->selectionModel()->selectedRows();
    return rows.isEmpty() ? -1 : rows.first().row();
  }

  std::unique_ptr<PanelCase> the_case_;
  std::unique_ptr<ui::LabelsPanel> panel_;
};

TIDEMARK_TEST(LabelsPanelTest)

}  // namespace tidemark::test::labels_panel_test

#include "labels_panel_test.moc"
