#include "ui/main/case_comparison.h"

#include <QPointer>

#include "engine/case_proxy.h"
#include "ui/main/case_links.h"
#include "ui/main/main_window.h"

namespace tidemark::ui {

CaseComparison::CaseComparison(MainWindow& window, CaseLinks& links)
    : QObject(&window), window_(window), links_(links) {}

void CaseComparison::duplicate(CaseWindow& original, std::function<void(CaseWindow&)> done) {
  original.proxy().pause();
  using Snapshot = engine::CaseProxy::Snapshot;
  original.proxy().take_snapshot(original.view_state(), [this, original = &original, done = std::move(done)](
                                                            const std::shared_ptr<const Snapshot>& snapshot) {
    engine::CaseProxy& proxy = original->proxy();
    const std::shared_ptr<const document::SessionContents> contents(snapshot, &snapshot->contents);
    CaseWindow* copy = window_.add_case(proxy.shared_study(), {contents, true});
    if (const auto executor = solver::executor_named(proxy.state().executor.toStdString()))
      copy->proxy().change_executor(*executor);
    if (done) done(*copy);
  });
}

void CaseComparison::compare_schemes(CaseWindow& original) {
  duplicate(original, [this, original = &original](CaseWindow& copy) {
    solver::Parameters parameters = copy.proxy().parameters();
    const bool is_paper = parameters.scheme == solver::Scheme::paper;
    parameters.scheme = is_paper ? solver::Scheme::split : solver::Scheme::paper;
    copy.proxy().set_parameters(parameters);
    const QList<CaseWindow*> both{original, &copy};
    links_.link(both);
    links_.play_together(window_.cases(), false);
    links_.play_together(both, true);
    original->proxy().play();
    // Once the copy is shown.
    const auto tile = [this] { window_.actions().tile->trigger(); };
    QMetaObject::invokeMethod(this, tile, Qt::QueuedConnection);
  });
}

}  // namespace tidemark::ui
