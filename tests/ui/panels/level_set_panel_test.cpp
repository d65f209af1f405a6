#include "ui/panels/level_set_panel.h"

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSettings>
#include <QSignalSpy>
#include <QSlider>
#include <QStandardItemModel>
#include <QStyle>
#include <QStyleOptionSlider>
#include <QToolButton>

#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"
#include "ui/panels/curve_plot.h"
#include "ui/panels/speed_plot.h"
#include "ui/widgets/disclosure.h"

namespace tidemark::test::level_set_panel_test {

// The middle of a slider's handle.
static QPoint handle_of(QSlider& slider) {
  QStyleOptionSlider option;
  option.initFrom(&slider);
  option.orientation = slider.orientation();
  option.minimum = slider.minimum();
  option.maximum = slider.maximum();
  option.sliderPosition = slider.sliderPosition();
  option.sliderValue = slider.value();
  option.subControls = QStyle::SC_All;
  return slider.style()
      ->subControlRect(QStyle::CC_Slider, &option, QStyle::SC_SliderHandle, &slider)
      .center();
}

class LevelSetPanelTest : public QObject {
  Q_OBJECT
 private slots:
  void init() {
    the_case_ = std::make_unique<PanelCase>();
    QSettings().remove("details");
    panel_ = shown<ui::LevelSetPanel>(*the_case_, 900);
    for (ui::Disclosure* fold : panel_->findChildren<ui::Disclosure*>()) fold->set_open(true);
    QCoreApplication::processEvents();
  }
  void cleanup() {
    panel_.reset();
    the_case_.reset();
  }

  void a_slider_dragged_in_mid_run_reaches_the_level_set_and_is_one_entry_of_the_history() {
    the_case_->begin();
    engine::CaseProxy& proxy = *the_case_->proxy;
    proxy.set_pause_at_convergence(false);
    proxy.play();
    QTRY_VERIFY(proxy.state().step > 5);
    auto* slider = named<QSlider>(*panel_, tr("Target T"));
    const QPoint handle = handle_of(*slider);
    drag(*slider, handle, handle - QPoint(30, 0));
    QVERIFY(proxy.state().playing);
    const double wanted = proxy.parameters().target;
    QVERIFY2(wanted < 90.0, qPrintable(QString::number(wanted)));
    QCOMPARE(named<QDoubleSpinBox>(*panel_, tr("Target T"))->value(), wanted);
    QTRY_COMPARE(proxy.state().parameters.target, wanted);
    proxy.pause();
    the_case_->wait_until_idle();
    proxy.undo();  // the drag, with the steps in between
    the_case_->wait_until_idle();
    if (proxy.state().parameters.target != 100.0) proxy.undo();  // steps after it were an entry
    the_case_->wait_until_idle();
    QCOMPARE(proxy.state().parameters.target, 100.0);
  }

  void a_typed_range_arrives() {
    auto* number = named<QDoubleSpinBox>(*panel_, tr("Range ε"));
    number->setFocus();
    number->selectAll();
    QTest::keyClicks(number, "33");
    QTest::keyClick(number, Qt::Key_Return);
    the_case_->wait_until_idle();
    QCOMPARE(the_case_->state().parameters.range, 33.0);
    QCOMPARE(panel_->findChild<ui::SpeedPlot*>()->range(), 33.0);
  }

  void to_the_right_the_data_weigh_more() {
    auto* slider = named<QSlider>(*panel_, tr("Data weight α"));
    slider->setFocus();
    const double before = the_case_->proxy->parameters().alpha;
    QTest::keyClick(slider, Qt::Key_Right);
    QVERIFY(the_case_->proxy->parameters().alpha > before);
    QTest::keyClick(slider, Qt::Key_End);
    QCOMPARE(the_case_->proxy->parameters().alpha, 1.0);
    QTest::keyClick(slider, Qt::Key_Home);
    QCOMPARE(the_case_->proxy->parameters().alpha, 0.0);
  }

  void the_ends_of_alpha_say_what_they_stand_for() {
    const auto* slider = named<QSlider>(*panel_, tr("Data weight α"));
    const auto middle = [this](const QString& text) {
      for (const QLabel* label : panel_->findChildren<QLabel*>()) {
        if (label->text() == text) return label->mapTo(panel_.get(), label->rect().center()).x();
      }
      return -1;
    };
    const int left = slider->mapTo(panel_.get(), QPoint()).x();
    QVERIFY(std::abs(middle(tr("smooth")) - left) < slider->width() / 2);
    QVERIFY(std::abs(middle(tr("follow data")) - (left + slider->width())) < slider->width() / 3);
  }

  void terms_can_be_switched_off_and_on() {
    auto* curvature = button<QCheckBox>(*panel_, tr("Curvature"));
    QTest::mouseClick(curvature, Qt::LeftButton, {}, {8, curvature->height() / 2});
    the_case_->wait_until_idle();
    QVERIFY(!the_case_->state().parameters.curvature_term);
    QVERIFY(the_case_->state().parameters.data_term);
    button<QCheckBox>(*panel_, tr("Data"))->setFocus();
    QTest::keyClick(button<QCheckBox>(*panel_, tr("Data")), Qt::Key_Space);
    QTest::mouseClick(curvature, Qt::LeftButton, {}, {8, curvature->height() / 2});
    the_case_->wait_until_idle();
    QVERIFY(the_case_->state().parameters.curvature_term);
    QVERIFY(!the_case_->state().parameters.data_term);
  }

  void details_are_folded_away_until_somebody_unfolds_them() {
    const ui::LevelSetPanel fresh;
    const auto folds = fresh.findChildren<ui::Disclosure*>();
    QCOMPARE(folds.size(), 4);
    for (const ui::Disclosure* fold : folds) QVERIFY(!fold->is_open());
    const auto is_folded = [](const ui::LevelSetPanel& in, const QString& name) {
      for (QWidget* widget : in.findChildren<QWidget*>()) {
        if (widget->accessibleName() != name) continue;
        for (const QWidget* at = widget; at != &in; at = at->parentWidget()) {
          if (at->isHidden()) return true;
        }
        return false;
      }
      qFatal("there is no %s", qPrintable(name));
    };
    for (const char* name : {"Picture every", "Computed by", "Scheme", "α as in the paper",
                             "Steps per second", "Resident pages", "Still moving", "Memory"})
      QVERIFY2(is_folded(fresh, tr(name)), name);
    for (const char* name : {"State of the evolution", "Target T", "Range ε", "Data weight α", "Step",
                             "Volume", "Area", "Motion"})
      QVERIFY2(!is_folded(fresh, tr(name)), name);

    // By a click, and the next time, too.
    auto shown_fresh = shown<ui::LevelSetPanel>(*the_case_, 900);
    auto* unfold = named<QToolButton>(*shown_fresh, tr("Details of the speed"));
    QTest::mouseClick(unfold, Qt::LeftButton);
    QVERIFY(!is_folded(*shown_fresh, tr("Scheme")));
    const ui::LevelSetPanel next;
    QVERIFY(!is_folded(next, tr("Scheme")));
    QVERIFY(is_folded(next, tr("Memory")));
    QTest::mouseClick(unfold, Qt::LeftButton);
    QVERIFY(is_folded(ui::LevelSetPanel(), tr("Scheme")));
  }

  void the_papers_data_term_and_another_band_can_be_chosen() {
    the_case_->begin();
    engine::CaseProxy& proxy = *the_case_->proxy;
    proxy.step(3);
    the_case_->wait_until_idle();
    const double by_voxels = the_case_->state().band;
    const double step_of_clamped = the_case_->state().time_step;
    auto* form = named<QComboBox>(*panel_, tr("Data term D"));
    form->setFocus();
    QTest::keyClick(form, Qt::Key_Down);
    the_case_->wait_until_idle();
    QVERIFY(the_case_->state().parameters.data_form == solver::DataForm::raw);
    QVERIFY(the_case_->state().time_step < step_of_clamped);
    QCOMPARE(the_case_->state().step, std::int64_t{3});

    // With another W it begins again, and undo leads back to where it was.
    auto* by_spacing = button<QCheckBox>(*panel_, tr("W by the voxels' spacing"));
    QVERIFY(by_spacing->isChecked());
    QCOMPARE(named<QDoubleSpinBox>(*panel_, tr("Band W"))->value(), by_voxels);
    type(tr("Band W"), "6");
    QCOMPARE(the_case_->state().band, 6.0);
    QCOMPARE(the_case_->state().step, std::int64_t{0});
    QVERIFY(the_case_->state().begun);
    QVERIFY(!by_spacing->isChecked());
    proxy.step(2);
    the_case_->wait_until_idle();
    QTest::mouseClick(by_spacing, Qt::LeftButton, {}, {8, by_spacing->height() / 2});
    the_case_->wait_until_idle();
    QCOMPARE(the_case_->state().band, by_voxels);
    QCOMPARE(the_case_->state().step, std::int64_t{0});
    for (int entry = 0; entry < 3; ++entry) {
      proxy.undo();
      the_case_->wait_until_idle();
    }
    QCOMPARE(the_case_->state().band, by_voxels);
    QCOMPARE(the_case_->state().step, std::int64_t{3});
  }

  void the_papers_scheme_can_be_chosen_is_undone_and_recorded() {
    the_case_->begin();
    engine::CaseProxy& proxy = *the_case_->proxy;
    proxy.step(2);
    the_case_->wait_until_idle();
    const double large_step = the_case_->state().time_step;
    auto* scheme = named<QComboBox>(*panel_, tr("Scheme"));
    scheme->setFocus();
    QTest::keyClick(scheme, Qt::Key_Down);
    the_case_->wait_until_idle();
    QVERIFY(the_case_->state().parameters.scheme == solver::Scheme::paper);
    QVERIFY(the_case_->state().time_step < large_step);
    proxy.step(3);
    type(tr("Rescaling w"), "0.5");
    type(tr("Target gradient"), "1.5");
    QCOMPARE(the_case_->state().parameters.rescale, std::optional(0.5));
    QCOMPARE(the_case_->state().parameters.target_gradient, 1.5);
    auto* by_band = button<QCheckBox>(*panel_, tr("w by the band's width"));
    QVERIFY(!by_band->isChecked());

    std::shared_ptr<const engine::CaseProxy::Snapshot> snapshot;
    proxy.take_snapshot({}, [&](const auto& taken) { snapshot = taken; });
    the_case_->wait_until_idle();
    QVERIFY(snapshot);
    const auto text = snapshot->contents.recipe.to_text();
    QCOMPARE(failure(text), QString());
    const auto recipe = document::Recipe::parse(*text, "recipe");
    QCOMPARE(failure(recipe), QString());
    QCOMPARE(recipe->final_parameters(), the_case_->state().parameters);
    QVERIFY(recipe->parameters.scheme == solver::Scheme::split);  // at the start

    QTest::mouseClick(by_band, Qt::LeftButton, {}, {8, by_band->height() / 2});
    the_case_->wait_until_idle();
    QVERIFY(!the_case_->state().parameters.rescale);
    const double shown_weight = named<QDoubleSpinBox>(*panel_, tr("Rescaling w"))->value();
    QVERIFY(std::abs(shown_weight - 0.75 / the_case_->state().band) < 0.001);
    for (int entry = 0; entry < 6; ++entry) {
      proxy.undo();
      the_case_->wait_until_idle();
      if (the_case_->state().parameters == the_case_->proxy->study().parameters) break;
    }
    QCOMPARE(the_case_->state().parameters, the_case_->proxy->study().parameters);
    QCOMPARE(scheme->currentText(), tr("Split"));
    QVERIFY(by_band->isChecked());
  }

  void what_is_changed_elsewhere_shows() {
    solver::Parameters parameters = the_case_->proxy->parameters();
    parameters.target = 42.0;
    parameters.alpha = 0.25;
    parameters.rescaling_term = false;
    the_case_->proxy->set_parameters(parameters);
    QCOMPARE(named<QDoubleSpinBox>(*panel_, tr("Target T"))->value(), 42.0);
    QCOMPARE(named<QDoubleSpinBox>(*panel_, tr("Data weight α"))->value(), 0.25);
    QCOMPARE(panel_->findChild<ui::SpeedPlot*>()->target(), 42.0);
    QVERIFY(!button<QCheckBox>(*panel_, tr("Rescaling"))->isChecked());
    // alpha / (alpha + (1 - alpha) epsilon) = 0.25 / (0.25 + 0.75 * 50)
    QVERIFY(named<QLabel>(*panel_, tr("α as in the paper"))
                ->text()
                .startsWith(QLocale().toString(0.0066, 'f', 4)));
  }

  void the_buttons_are_those_of_the_window() {
    QAction play(tr("Play"));
    QAction step(tr("Step"));
    QAction back(tr("Back"));
    QAction restart(tr("Restart"));
    panel_->set_actions({&play, &step, &back, &restart});
    QSignalSpy spy(&step, &QAction::triggered);
    QTest::mouseClick(button<QToolButton>(*panel_, tr("Step")), Qt::LeftButton);
    QCOMPARE(spy.count(), 1);
    play.setEnabled(false);
    QVERIFY(!button<QToolButton>(*panel_, tr("Play"))->isEnabled());
  }

  void steps_per_picture_and_pausing_are_the_sessions() {
    auto* steps = named<QComboBox>(*panel_, tr("Picture every"));
    steps->setFocus();
    QTest::keyClicks(steps, "5");
    QCOMPARE(the_case_->proxy->steps_per_picture(), std::int64_t{5});
    auto* pause = button<QCheckBox>(*panel_, tr("Pause at convergence"));
    QVERIFY(pause->isChecked());
    QTest::mouseClick(pause, Qt::LeftButton, {}, {8, pause->height() / 2});
    QVERIFY(!the_case_->proxy->pause_at_convergence());
  }

  void executors_that_cannot_run_are_grey_and_say_why() {
    auto* executor = named<QComboBox>(*panel_, tr("Computed by"));
    QCOMPARE(executor->currentData().toString(), QStringLiteral("host"));
    auto* items = qobject_cast<QStandardItemModel*>(executor->model());
    for (const char* name : {"compute", "stream"}) {
      const int row = executor->findData(QLatin1String(name));
      QVERIFY(!items->item(row)->isEnabled());
      QVERIFY(executor->itemData(row, Qt::ToolTipRole).toString().contains(QStringLiteral("OpenGL")));
    }
    QVERIFY(items->item(executor->findData(QStringLiteral("automatic")))->isEnabled());
    executor->setFocus();
    executor->activated(executor->findData(QStringLiteral("automatic")));
    the_case_->wait_until_idle();
    QCOMPARE(executor->currentData().toString(), QStringLiteral("host"));
  }

  void figures_and_curves_follow_the_run_to_convergence() {
    the_case_->begin();
    QVERIFY(button<QLabel>(*panel_, tr("paused")));
    the_case_->proxy->play();
    QTRY_VERIFY_WITH_TIMEOUT(the_case_->state().converged, 60000);
    the_case_->wait_until_idle();
    QVERIFY(button<QLabel>(*panel_, tr("converged")));
    QCOMPARE(named<QLabel>(*panel_, tr("Step"))->text(), QString::number(the_case_->state().step));
    auto* volume = named<ui::CurvePlot>(*panel_, tr("Volume"));
    QVERIFY(volume->points().size() > 1);
    QCOMPARE(volume->points().back().y(), the_case_->state().surface.volume_ml);
    const double ball_ml = 4.0 / 3.0 * M_PI * std::pow(kBallRadius, 3) / 1000.0;
    QVERIFY(std::abs(volume->points().back().y() - ball_ml) < 0.1 * ball_ml);
    const auto& motion = named<ui::CurvePlot>(*panel_, tr("Motion"))->points();
    QVERIFY2(motion.back().y() < 0.05, qPrintable(QString::number(motion.back().y())));
    QCOMPARE(named<QLabel>(*panel_, tr("Still moving"))->text(), tr("nowhere"));
  }

  void without_a_session_it_is_grey_and_says_what_is_missing() {
    panel_->set_proxy(nullptr);
    QVERIFY(button<QLabel>(*panel_, tr("Open a study to steer a level set in it."))->isVisible());
    QVERIFY(!named<QSlider>(*panel_, tr("Target T"))->isEnabled());
    panel_->set_proxy(the_case_->proxy.get());
    QVERIFY(named<QSlider>(*panel_, tr("Target T"))->isEnabled());
  }

  void a_session_may_die_while_the_panel_lives_even_in_a_drag() {
    auto& tent = *panel_->findChild<ui::SpeedPlot*>();
    const QPoint peak = tent.peak().toPoint();
    QTest::mousePress(&tent, Qt::LeftButton, {}, peak);
    QTest::mouseMove(&tent, peak + QPoint(10, 0));
    the_case_->proxy.reset();
    QVERIFY(panel_->proxy() == nullptr);
    QTest::mouseMove(&tent, peak + QPoint(20, 0));
    QTest::mouseRelease(&tent, Qt::LeftButton, {}, peak + QPoint(20, 0));
    QVERIFY(!tent.isEnabled());
    panel_->grab();
  }

  void another_session_shows_its_own() {
    PanelCase other;
    solver::Parameters parameters = other.proxy->parameters();
    parameters.target = 11.0;
    other.proxy->set_parameters(parameters);
    panel_->set_proxy(other.proxy.get());
    QCOMPARE(named<QDoubleSpinBox>(*panel_, tr("Target T"))->value(), 11.0);
    parameters = the_case_->proxy->parameters();
    parameters.target = 77.0;
    the_case_->proxy->set_parameters(parameters);  // no longer shown
    QCOMPARE(named<QDoubleSpinBox>(*panel_, tr("Target T"))->value(), 11.0);
    panel_->set_proxy(nullptr);
  }

 private:
  void type(const QString& name, const char* text) {
    auto* number = named<QDoubleSpinBox>(*panel_, name);
    number->setFocus();
    number->selectAll();
    QTest::keyClicks(number, text);
    QTest::keyClick(number, Qt::Key_Return);
    the_case_->wait_until_idle();
  }

  std::unique_ptr<PanelCase> the_case_;
  std::unique_ptr<ui::LevelSetPanel> panel_;
};

TIDEMARK_TEST(LevelSetPanelTest)

}  // namespace tidemark::test::level_set_panel_test

#include "level_set_panel_test.moc"
