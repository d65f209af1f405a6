// Colours of distances on the surface: those of one map never stand for those of another.
#include "engine/surface_maps.h"

#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"
#include "ui/views/slice_view.h"
#include "ui/views/volume_view.h"

namespace tidemark::test::surface_map_test {

class SurfaceMapTest : public QObject {
  Q_OBJECT

 private slots:
  void while_a_map_is_made_there_are_no_colours() {
    using engine::SurfaceMap;
    test::PanelCase the_case;
    the_case.begin(8.0);
    engine::CaseProxy& proxy = *the_case.proxy;
    proxy.compare_with(std::make_shared<const BitMask>(the_case.state().phi->mask()));
    the_case.begin(6.0);
    const ui::SliceViewWidget slice(proxy, ui::SlicePlane::axial, renderer::SliceContent::source);
    const ui::VolumeViewWidget volume(proxy);
    const ui::PictureView& slice_view = slice;
    const auto have_colours = [&](bool wanted) {
      return std::get<renderer::SliceView>(slice_view.wanted()).change == wanted &&
             volume.view().change == wanted;
    };
    const auto ask_for = [&](bool truth_error) {
      proxy.display().change([=](engine::DisplaySettings& settings) { settings.truth_error = truth_error; });
    };
    QVERIFY(have_colours(true));  // of the change since the start
    ask_for(true);
    QVERIFY(have_colours(false));
    QTRY_VERIFY_WITH_TIMEOUT(the_case.state().surface_map == SurfaceMap::truth_error, 60000);
    QVERIFY(have_colours(true));
    ask_for(false);
    QVERIFY(have_colours(false));
    QTRY_VERIFY_WITH_TIMEOUT(the_case.state().surface_map == SurfaceMap::none, 60000);
    QVERIFY(have_colours(true));
  }

  void without_a_truth_the_change_keeps_its_colours() {
    test::PanelCase the_case;
    the_case.begin();
    const ui::VolumeViewWidget view(*the_case.proxy);
    the_case.proxy->display().change([](engine::DisplaySettings& settings) { settings.truth_error = true; });
    QVERIFY(view.view().change);
  }
};

TIDEMARK_TEST(SurfaceMapTest)

}  // namespace tidemark::test::surface_map_test

#include "surface_map_test.moc"
