// What views and figures show of a case whose speed function is missing: nothing of the tent.
#include <QLabel>
#include <algorithm>

#include "engine/case_balance.h"
#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"
#include "ui/main/value_bar.h"
#include "ui/panels/balance_controls.h"
#include "ui/views/slice_view.h"
#include "ui/views/volume_view.h"

namespace tidemark::test::lacking_speed_test {

class LackingSpeedTest : public QObject {
  Q_OBJECT

  std::unique_ptr<engine::Engine> engine_;
  std::unique_ptr<engine::CaseProxy> proxy_;

  [[nodiscard]] glm::dvec3 middle() const { return renderer::middle_of(proxy_->volume().geometry); }
  void drive_by_the_tent() {
    proxy_->set_drive({});
    QTRY_VERIFY_WITH_TIMEOUT(!proxy_->state().lacks_speed, 60000);
  }

 private slots:
  void init() {
    engine_ = std::make_unique<engine::Engine>(false);
    proxy_ = std::make_unique<engine::CaseProxy>(*engine_, ball_study(), solver::ExecutorKind::host,
                                                 engine::RestoredCase{ball_without_its_map(), false});
    const auto lacks = [&] {
      const engine::CaseState& state = proxy_->state();
      return state.begun && state.phi && state.lacks_speed && !state.speed_waits;
    };
    QTRY_VERIFY_WITH_TIMEOUT(lacks(), 60000);
  }
  void cleanup() {
    proxy_.reset();
    engine_.reset();
  }

  void the_value_bar_has_no_number_for_it() {
    ui::ValueBar bar;
    bar.set_proxy(proxy_.get());
    bar.set_detailed(true);
    proxy_->display().set_pointer(middle());
    QVERIFY2(bar.text().contains("D –"), qPrintable(bar.text()));
    drive_by_the_tent();
    QVERIFY2(!bar.text().contains("D –"), qPrintable(bar.text()));
  }

  void slices_show_no_speed() {
    ui::SliceViewWidget view(*proxy_, ui::SlicePlane::axial, renderer::SliceContent::speed);
    const ui::PictureView& base = view;
    const auto term = [&](renderer::SpeedTerm chosen) {
      proxy_->display().change([=](engine::DisplaySettings& settings) { settings.speed_term = chosen; });
      return std::get<renderer::SliceView>(base.wanted()).term;
    };
    QVERIFY(term(renderer::SpeedTerm::data) == renderer::SpeedTerm::doubt);
    QVERIFY(term(renderer::SpeedTerm::total) == renderer::SpeedTerm::doubt);
    QVERIFY(term(renderer::SpeedTerm::curvature) == renderer::SpeedTerm::curvature);
    drive_by_the_tent();
    QVERIFY(term(renderer::SpeedTerm::data) == renderer::SpeedTerm::data);
  }

  void the_surface_has_no_colours_of_it() {
    using renderer::SurfaceColouring;
    const ui::VolumeViewWidget view(*proxy_);
    const auto shown = [&](SurfaceColouring chosen) {
      proxy_->display().change([=](engine::DisplaySettings& settings) { settings.colouring = chosen; });
      return view.view().colouring;
    };
    QVERIFY(shown(SurfaceColouring::data) == SurfaceColouring::plain);
    QVERIFY(shown(SurfaceColouring::total_speed) == SurfaceColouring::plain);
    QVERIFY(shown(SurfaceColouring::curvature_term) == SurfaceColouring::curvature_term);
    drive_by_the_tent();
    QVERIFY(shown(SurfaceColouring::data) == SurfaceColouring::data);
  }

  void why_says_that_it_is_missing() {
    ui::BalanceControls controls;
    controls.set_proxy(proxy_.get());
    controls.resize(300, 400);
    test::show(controls);
    proxy_->balance().ask(middle() + glm::dvec3(6.0, 0.0, 0.0));
    const auto says_so = [&] {
      return std::ranges::any_of(controls.findChildren<QLabel*>(), [](const QLabel* label) {
        return label->isVisible() && label->text().contains("The speed function is missing");
      });
    };
    QTRY_VERIFY(says_so());
    drive_by_the_tent();
    QTRY_VERIFY_WITH_TIMEOUT(proxy_->balance().place(), 60000);
    QTRY_VERIFY(!says_so());
  }
};

TIDEMARK_TEST(LackingSpeedTest)

}  // namespace tidemark::test::lacking_speed_test

#include "lacking_speed_test.moc"
