// The commands of a case about its labels.
#include <algorithm>
#include <utility>

#include "document/label_segments.h"
#include "engine/case_proxy.h"
#include "engine/case_runner.h"

namespace tidemark::engine {

void CaseProxy::add_label(const QString& name) {
  post([name = name.toStdString()](CaseRunner& runner, const Progress&) -> Status {
    const auto id = runner.document().labels().add(name);
    if (!id) return pass_on(id);
    return runner.report_labels({});
  });
}

void CaseProxy::set_label(const document::Label& label) {
  post([label](CaseRunner& runner, const Progress&) {
    return runner.report_labels(runner.document().labels().set(label));
  });
}

const document::Label* CaseProxy::chosen_label() const {
  const auto chosen =
      std::find_if(state_.labels.begin(), state_.labels.end(),
                   [&](const document::Label& label) { return label.id == display_.label_brush().label; });
  if (chosen != state_.labels.end()) return &*chosen;
  return state_.labels.empty() ? nullptr : &state_.labels.back();
}

void CaseProxy::remove_label(std::uint8_t id) {
  post([id](CaseRunner& runner, const Progress&) {
    return runner.report_labels(runner.document().labels().remove(id));
  });
}

void CaseProxy::import_labels(std::shared_ptr<const imaging::Segments> segments) {
  post([segments = std::move(segments)](CaseRunner& runner, const Progress&) {
    return runner.report_labels(document::add_segments(runner.document().labels(), *segments));
  });
}

void CaseProxy::accept_surface(std::uint8_t label, document::Take take, const QString& another) {
  post([=, name = another.toStdString()](CaseRunner& runner, const Progress&) {
    return runner.report_acceptance(runner.document().accept_surface(label, take, name));
  });
}

void CaseProxy::finish_labels(std::shared_ptr<const std::vector<document::LabelRegion>> regions,
                              document::Take take, const std::optional<document::LabelVoxels>& from) {
  post([regions = std::move(regions), take, from](CaseRunner& runner, const Progress&) -> Status {
    document::Labels& labels = runner.document().labels();
    if (from && (from->list != labels.list() || from->all() != labels.voxels()))
      return fail(ErrorKind::usage, "the labels have changed since the preview: look again");
    return runner.report_acceptance(labels.finish(*regions, take));
  });
}

void CaseProxy::brush_label(document::LabelRegion stroke, document::Labels::Stroke what,
                            document::Take take) {
  post([stroke = std::move(stroke), what, take](CaseRunner& runner, const Progress&) mutable -> Status {
    document::Labels& labels = runner.document().labels();
    // The stroke before it may have made the label.
    if (stroke.label == 0 && !labels.list().empty()) stroke.label = labels.list().back().id;
    if (stroke.label == 0 && what == document::Labels::Stroke::erases) return {};
    return runner.report_acceptance(labels.brush(std::move(stroke), what, take));
  });
}

void CaseProxy::begin_from_label(std::uint8_t label, std::optional<double> within_mm, int levels) {
  post([label, within_mm, levels](CaseRunner& runner, const Progress&) {
    runner.set_playing(false);
    return runner.report_edit(runner.document().begin_from_label(label, within_mm, levels));
  });
}

}  // namespace tidemark::engine
