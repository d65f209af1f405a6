// What the transfer function editor's controls do to the display, and the other way round.
#include <QColorDialog>

#include "core/atomic_file.h"
#include "editor_fixture.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"
#include "tests/ui/file_dialog.h"
#include "tests/ui/main/desktop.h"

namespace tidemark::test::transfer_editor_test {

namespace {

void click(QWidget* page, const char* button) {
  auto* found = page->findChild<QPushButton*>(QString::fromLatin1(button));
  QVERIFY2(found != nullptr, button);
  QTest::mouseClick(found, Qt::LeftButton);
}

// As a user types a number.
void type(QDoubleSpinBox* box, const QString& text) {
  box->setFocus();
  box->selectAll();
  QTest::keyClicks(box, text);
  QTest::keyClick(box, Qt::Key_Return);
}

// As a user picks from an open list.
void pick(QComboBox* box, int index) {
  box->setCurrentIndex(index);
  emit box->activated(index);
}

// By the button and the dialog that it opens.
void save_as(ui::TransferFunctionEditor& editor, const std::filesystem::path& file) {
  name_file_when_asked(QString::fromStdString(file.string()));
  QTest::mouseClick(seen<QPushButton>(editor, "Save…"), Qt::LeftButton);
}

}  // namespace

class TransferEditorTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() { QCoreApplication::setAttribute(Qt::AA_DontUseNativeDialogs); }

  void primitives_are_added_copied_and_deleted() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    ui::PrimitivePage* page = f.editor.volume_page();
    click(page, "add_ramp");
    QCOMPARE(f.function().source.size(), std::size_t{3});
    QVERIFY(f.function().source[2].value.kind == renderer::TransferFactor::Kind::ramp);
    QCOMPARE(f.display.settings().chosen_primitive, 2);
    click(page, "add_gaussian");
    QVERIFY(f.function().source[3].value.kind == renderer::TransferFactor::Kind::gaussian);
    QVERIFY(f.function().source[3].colour != f.function().source[2].colour);
    page->list()->list()->setCurrentRow(0);
    QCOMPARE(f.display.settings().chosen_primitive, 0);
    click(page, "duplicate");
    QCOMPARE(f.function().source.size(), std::size_t{5});
    QVERIFY(f.function().source[4] == f.function().source[0]);
    click(page, "delete");
    QCOMPARE(f.function().source.size(), std::size_t{4});
    QTest::keyClick(page->list()->list(), Qt::Key_Delete);
    QCOMPARE(f.function().source.size(), std::size_t{3});
    QCOMPARE(page->list()->list()->count(), 3);
  }

  void there_are_never_more_primitives_than_shaders_take() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    for (int i = 0; i < 20; ++i) click(f.editor.volume_page(), "add_gaussian");
    QCOMPARE(f.function().source.size(), renderer::TransferFunction::kMostPrimitives);
    QVERIFY(!f.editor.volume_page()->findChild<QPushButton*>("duplicate")->isEnabled());
    for (int i = 0; i < 20; ++i) click(f.editor.volume_page(), "delete");
    QVERIFY(f.function().source.empty());
    QVERIFY(!f.editor.volume_page()->form()->isEnabled());
  }

  void exact_numbers_are_taken_and_leave_the_others_as_they_are() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    f.display.change([](engine::DisplaySettings& s) {
      s.transfer.source[0].value = {renderer::TransferFactor::Kind::gaussian, 12.3456789, 98.7654321};
    });
    ui::PrimitiveForm* form = f.editor.volume_page()->form();
    type(form->factor(0)->start_box(), "75");
    QCOMPARE(f.function().source[0].value.start, 75.0);
    QCOMPARE(f.function().source[0].value.end, 98.7654321);
    type(form->opacity_box(), QLocale().toString(0.125));
    QCOMPARE(f.function().source[0].opacity, 0.125);
    QCOMPARE(f.function().source[0].value.end, 98.7654321);
    pick(form->factor(2)->kind_box(), 2);
    QVERIFY(f.function().source[0].phi.kind == renderer::TransferFactor::Kind::ramp);
    type(form->factor(2)->start_box(), "3");
    type(form->factor(2)->end_box(), "3");
    QVERIFY(f.function().source[0].phi.start == 3.0);
    QVERIFY(f.function().source[0].phi.end != 3.0);
  }

  void it_fits_into_the_column_of_panels() {
    constexpr int kColumn = 320;
    EditorFixture f;
    QVERIFY(f.is_shown());
    // As many numbers as there can be.
    for (int axis = 0; axis < 3; ++axis) pick(f.editor.volume_page()->form()->factor(axis)->kind_box(), 1);
    for (int tab = 0; tab < f.editor.tabs()->count(); ++tab) {
      f.editor.tabs()->setCurrentIndex(tab);
      f.editor.resize(kColumn, 700);
      QCoreApplication::processEvents();
      QCOMPARE(f.editor.width(), kColumn);
      for (const QWidget* control : f.editor.tabs()->currentWidget()->findChildren<QWidget*>()) {
        if (!control->isVisible() || control->focusPolicy() == Qt::NoFocus) continue;
        const int right = control->mapTo(&f.editor, QPoint(control->width(), 0)).x();
        QVERIFY2(right <= kColumn,
                 qPrintable(QString("%1 %2: %3")
                                .arg(control->metaObject()->className(), control->accessibleName())
                                .arg(right)));
      }
    }
  }

  void a_gaussian_becomes_a_ramp_where_it_is() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    pick(f.editor.volume_page()->form()->factor(0)->kind_box(), 2);
    QVERIFY((f.function().source[0].value ==
             renderer::TransferFactor{renderer::TransferFactor::Kind::ramp, -200.0, 200.0}));
  }

  void colours_are_seen_while_they_are_chosen_and_can_be_taken_back() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    QTest::mouseClick(f.editor.volume_page()->form()->colour_button(), Qt::LeftButton);
    auto* dialog = f.editor.findChild<QColorDialog*>();
    QVERIFY(dialog != nullptr);
    dialog->setCurrentColor(QColor(0, 255, 0));
    QVERIFY((f.function().source[0].colour == glm::vec3{0.0F, 1.0F, 0.0F}));
    dialog->reject();
    QVERIFY((f.function().source[0].colour == glm::vec3{0.9F, 0.4F, 0.3F}));
  }

  void a_preset_replaces_the_function_and_is_made_absolute_by_an_edit() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    ui::PresetPicker* presets = f.editor.presets();
    QCOMPARE(presets->count(), static_cast<int>(renderer::preset_names().size()));
    QCOMPARE(presets->currentIndex(), -1);
    const int mr = presets->findText("MR T1 head");
    QVERIFY(mr >= 0);
    pick(presets, mr);
    QVERIFY(f.function() == renderer::preset("mr-head").value());
    QVERIFY(f.display.settings().show_source);
    // 0.12 and 0.7 of the common range, -1000 to 800.
    ui::PrimitiveForm* form = f.editor.volume_page()->form();
    QCOMPARE(form->factor(0)->start_box()->value(), -784.0);
    QCOMPARE(form->factor(0)->end_box()->value(), 260.0);
    type(form->factor(0)->end_box(), "300");
    QVERIFY(!f.function().relative);
    QCOMPARE(f.function().source[0].value.end, 300.0);
    QVERIFY(std::abs(f.function().source[0].value.start + 784.0) < 1e-9);
    QCOMPARE(presets->currentIndex(), -1);
    f.display.change([](engine::DisplaySettings& s) { s.transfer = renderer::preset("ct-bone").value(); });
    QCOMPARE(presets->currentText(), QString("CT bone"));
  }

  void pictures_of_presets_differ() {
    EditorFixture f;
    std::vector<QImage> pictures;
    for (int i = 0; i < f.editor.presets()->count(); ++i) {
      pictures.push_back(f.editor.presets()->itemIcon(i).pixmap(64, 40).toImage());
      QCOMPARE(pictures.back().deviceIndependentSize(), QSizeF(64.0, 40.0));
      for (int j = 0; j < i; ++j) QVERIFY(pictures[static_cast<std::size_t>(j)] != pictures.back());
    }
  }

  void a_colour_that_is_being_chosen_stays_with_its_case() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    tidemark::engine::Display other;  // X11 has one, too
    other.change([](engine::DisplaySettings& s) { s.transfer = renderer::preset("ct-lung").value(); });
    QTest::mouseClick(f.editor.volume_page()->form()->colour_button(), Qt::LeftButton);
    auto* dialog = f.editor.findChild<QColorDialog*>();
    QVERIFY(dialog != nullptr);
    dialog->setCurrentColor(QColor(0, 255, 0));
    f.editor.set_display(&other, &f.summary);
    QVERIFY((f.function().source[0].colour == glm::vec3{0.9F, 0.4F, 0.3F}));
    QVERIFY(other.settings().transfer == renderer::preset("ct-lung").value());
    QVERIFY(!dialog->isVisible());
    f.editor.set_display(nullptr, nullptr);
  }

  void a_function_that_is_being_loaded_is_for_no_other_case() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    const TemporaryFolder folder;
    const auto file = folder / "bone.json";
    QVERIFY(write_file(file, renderer::preset("ct-bone").value().to_json()).has_value());
    tidemark::engine::Display other;  // X11 has one, too
    other.change([](engine::DisplaySettings& s) { s.transfer = renderer::preset("ct-lung").value(); });
    bool asked = false;
    QTimer another_case;
    connect(&another_case, &QTimer::timeout, this, [&] {
      auto* dialog = f.editor.findChild<QFileDialog*>();
      if (!dialog || !dialog->isVisible()) return;
      asked = true;
      f.editor.set_display(&other, &f.summary);
      if (dialog->isVisible()) name_file(*dialog, QString::fromStdString(file.string()));
    });
    another_case.start(20);
    QTest::mouseClick(seen<QPushButton>(f.editor, "Load…"), Qt::LeftButton);
    QVERIFY(asked);
    QVERIFY(other.settings().transfer == renderer::preset("ct-lung").value());
    f.editor.set_display(nullptr, nullptr);
  }

  void a_wheel_that_scrolls_the_panel_changes_no_number() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    QDoubleSpinBox* box = f.editor.volume_page()->form()->factor(0)->start_box();
    const auto wheel = [&] {
      QWheelEvent event({5.0, 5.0}, box->mapToGlobal(QPointF(5.0, 5.0)), {}, {0, 120}, Qt::NoButton, {},
                        Qt::NoScrollPhase, false);
      QCoreApplication::sendEvent(box, &event);
    };
    wheel();
    QCOMPARE(f.function().source[0].value.start, 0.0);
    QVERIFY(QTest::qWaitForWindowActive(&f.editor));
    box->setFocus();
    QTRY_VERIFY(box->hasFocus());
    wheel();
    QVERIFY(f.function().source[0].value.start > 0.0);
  }

  void the_region_of_interest_is_chosen() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    pick(f.editor.region_box(), 1);
    QVERIFY(f.display.settings().region == renderer::Region::inside);
    f.display.change([](engine::DisplaySettings& s) { s.region = renderer::Region::tinted; });
    QCOMPARE(f.editor.region_box()->currentIndex(), 3);
  }

  void the_distance_axis_is_greyed_until_there_is_a_clip_plane() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    f.editor.tabs()->setCurrentIndex(1);
    const auto reason_is_shown = [&] {
      const auto labels = f.editor.surface_page()->findChildren<QLabel*>();
      return std::any_of(labels.begin(), labels.end(), [](QLabel* label) {
        return label->isVisible() && label->text().contains("clip plane");
      });
    };
    QVERIFY(reason_is_shown());
    const QImage greyed = f.editor.surface_page()->shown_plot()->grab().toImage();
    f.display.change([](engine::DisplaySettings& s) { s.clip_on = true; });
    QVERIFY(!reason_is_shown());
    QTest::qWait(20);
    QVERIFY(f.editor.surface_page()->shown_plot()->grab().toImage() != greyed);
    f.display.change([](engine::DisplaySettings& s) { s.clip_on = false; });
    QVERIFY(reason_is_shown());
  }

  void surface_primitives_are_dragged_in_mm() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    f.editor.tabs()->setCurrentIndex(1);
    f.display.change([](engine::DisplaySettings& s) {
      s.clip_on = true;
      s.transfer = renderer::preset("surface-near-plane").value();
    });
    ui::TransferPlot& plot = *f.editor.surface_page()->shown_plot();
    const ui::HandleKind start{ui::Grip::none, ui::Grip::start, false};
    const ui::PlotAxis y = plot.y_axis();
    const QPoint from = f.at(start);
    f.drag(plot, from, from + QPoint(0, -20));
    QVERIFY(std::abs(f.function().surface[0].distance.start - y.value(y.pixel(25.0) - 20.0)) < 1e-6);
    QCOMPARE(f.function().surface[0].distance.end, 5.0);
    click(f.editor.surface_page(), "add_gaussian");
    QCOMPARE(f.function().surface.size(), std::size_t{3});
    QVERIFY(f.function().surface[2].distance.kind == renderer::TransferFactor::Kind::gaussian);
    QCOMPARE(f.editor.surface_page()->list()->list()->currentRow(), 2);
    QCOMPARE(f.display.settings().chosen_primitive, 0);
  }

  void what_is_saved_can_be_loaded() {
    EditorFixture f;
    const TemporaryFolder folder;
    const renderer::TransferFunction before = f.function();
    f.editor.save(folder / "mine.json");
    QCOMPARE(f.editor.message(), QString());
    pick(f.editor.presets(), 0);
    QVERIFY(!(f.function().source == before.source));
    f.editor.load(folder / "mine.json");
    QVERIFY(f.function().source == before.source);
    QCOMPARE(f.function().name, std::string("mine"));
  }

  void a_file_has_its_ending_whatever_its_folder_is_called() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    const TemporaryFolder folder;
    const std::filesystem::path folder_with_a_dot = folder / "anna.maria";
    std::filesystem::create_directory(folder_with_a_dot);
    save_as(f.editor, folder_with_a_dot / "bones");
    QCOMPARE(f.editor.message(), QString());
    QVERIFY(!std::filesystem::exists(folder_with_a_dot / "bones"));
    QVERIFY(std::filesystem::exists(folder_with_a_dot / "bones.json"));
    save_as(f.editor, folder_with_a_dot / "v1.2.json");
    QVERIFY(std::filesystem::exists(folder_with_a_dot / "v1.2.json"));
  }

  void another_file_is_replaced_only_when_that_is_wanted() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    const TemporaryFolder folder;
    QCOMPARE(failure(write_file(folder / "bones.json", "precious")), QString());
    Desktop::answer(QMessageBox::No);
    save_as(f.editor, folder / "bones");
    QCOMPARE(bytes_of(folder / "bones.json"), QByteArray("precious"));
    Desktop::answer(QMessageBox::Yes);
    save_as(f.editor, folder / "bones");
    QVERIFY(bytes_of(folder / "bones.json").contains("\"bones\""));  // the name of the function
  }

  void what_is_wrong_with_a_file_is_said_and_nothing_is_changed() {
    EditorFixture f;
    const TemporaryFolder folder;
    const renderer::TransferFunction before = f.function();
    f.editor.load(folder / "none.json");
    QVERIFY(f.editor.message().contains("none.json"));
    QVERIFY(f.function() == before);
    f.editor.save(folder / "no folder" / "x.json");
    QVERIFY(f.editor.message().contains("x.json"));
    f.editor.save(folder / "good.json");
    QCOMPARE(f.editor.message(), QString());
  }

  void it_follows_another_case_and_greys_out_without_one() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    {
      tidemark::engine::Display other;  // X11 has one, too
      other.change([](engine::DisplaySettings& s) { s.transfer = renderer::preset("ct-lung").value(); });
      f.editor.set_display(&other, &f.summary);
      QCOMPARE(f.editor.volume_page()->list()->list()->count(), 3);
      f.display.change([](engine::DisplaySettings& s) { s.transfer.source.clear(); });
      QCOMPARE(f.editor.volume_page()->list()->list()->count(), 3);
    }
    QVERIFY(!f.editor.tabs()->isEnabled());
    QVERIFY(f.editor.message().contains("Open a study"));
    f.editor.set_display(&f.display, &f.summary, "HU");
    QVERIFY(f.editor.tabs()->isEnabled());
    QCOMPARE(f.editor.message(), QString());
    QCOMPARE(f.editor.volume_page()->list()->list()->count(), 0);
  }

  void a_study_without_a_histogram_can_be_edited() {
    EditorFixture f;
    const engine::SourceSummary empty;
    f.editor.set_display(&f.display, &empty);
    QVERIFY(f.is_shown());
    f.drag(f.plot(), f.at(kCentre), f.at(kCentre) + QPoint(10, 0));
    QVERIFY(f.function().source[0].value.start > 0.0);
  }

  void every_control_has_a_name_and_a_tip() {
    EditorFixture f;
    QVERIFY(f.is_shown());
    int controls = 0;
    for (QWidget* widget : f.editor.findChildren<QWidget*>()) {
      const bool control = qobject_cast<QAbstractButton*>(widget) || qobject_cast<QComboBox*>(widget) ||
                           qobject_cast<QDoubleSpinBox*>(widget) || qobject_cast<ui::TransferPlot*>(widget);
      if (!control || widget->objectName().startsWith("qt_") || !widget->isVisible()) continue;
      if (qobject_cast<QTabBar*>(widget->parentWidget())) continue;
      ++controls;
      auto* button = qobject_cast<QAbstractButton*>(widget);
      const QString name =
          button && widget->accessibleName().isEmpty() ? button->text() : widget->accessibleName();
      QVERIFY2(!name.isEmpty(), widget->metaObject()->className());
      QVERIFY2(!widget->toolTip().isEmpty(), qPrintable(name));
    }
    QVERIFY(controls >= 15);
  }
};

TIDEMARK_TEST(TransferEditorTest)

}  // namespace tidemark::test::transfer_editor_test

#include "transfer_editor_test.moc"
