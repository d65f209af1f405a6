// What files hold of a case, and whether they hold it as it is.
#include <algorithm>
#include <iterator>
#include <utility>

#include "core/without_exceptions.h"
#include "engine/case_proxy.h"
#include "engine/case_runner.h"
#include "engine/last_call.h"

namespace tidemark::engine {

Attachments CaseProxy::attachments() const {
  return attachments_of(display_.settings());
}

Attachments CaseProxy::attachments_of(const DisplaySettings& settings) const {
  Attachments found;
  for (const ShownImage& shown : settings.images) found.images.push_back(shown.image);
  if (has_another_truth()) found.truth = truth_;
  std::ranges::copy_if(settings.measurements, std::back_inserter(found.measurements), &Measurement::complete);
  return found;
}

// An image is read again, so that another one may be the same; an accepted registration moves it.
bool CaseProxy::has_saved_attachments() const {
  const auto is_same = [](const auto& a, const auto& b) {
    return a->name == b->name && a->checksum == b->checksum && a->to_case == b->to_case;
  };
  const Attachments now = attachments();
  return now.truth == saved_.truth && now.measurements == saved_.measurements &&
         std::ranges::is_permutation(now.images, saved_.images, is_same);
}

bool CaseProxy::modified() const {
  return case_modified_ || !has_saved_attachments();
}

void CaseProxy::follow_modified() {
  const bool now = modified();
  if (std::exchange(state_.modified, now) != now) emit state_changed();
}

void CaseProxy::take_snapshot(std::string view_state,
                              std::function<void(std::shared_ptr<const Snapshot>)> answer,
                              std::function<void()> gave_up, OpenChange open) {
  using Taken = Result<std::shared_ptr<const Snapshot>>;
  post([view_state = std::move(view_state), attachments = attachments(), open, answer = std::move(answer),
        unanswered = std::make_shared<LastCall>(askers_, std::move(gave_up)),
        askers = askers_](CaseRunner& runner, const Progress&) -> Status {
    const Taken taken = without_exceptions([&]() -> Taken {
      document::Case& document = runner.document();
      document.view_state = view_state;
      if (open == OpenChange::ends) {
        TIDEMARK_TRY(document.history().close());
      }
      auto contents = document::snapshot_of(document);
      if (!contents) return pass_on(contents);
      contents->images = attachments.images;
      contents->truth = attachments.truth;
      return std::make_shared<const Snapshot>(
          Snapshot{std::move(*contents), attachments, document.history().position()});
    });
    if (!taken) return pass_on(taken);
    askers->send([answer, snapshot = *taken] { answer(snapshot); });
    unanswered->forget();
    return {};
  });
}

void CaseProxy::mark_saved(const Snapshot& snapshot) {
  saved_ = snapshot.attachments;
  mark_surface_saved(snapshot.position);
}

void CaseProxy::mark_surface_saved(std::uint64_t position) {
  post([position](CaseRunner& runner, const Progress&) -> Status {
    runner.mark_saved(position);
    return {};
  });
}

}  // namespace tidemark::engine
