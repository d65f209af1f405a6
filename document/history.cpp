#include "document/history.h"

#include <utility>

namespace tidemark::document {

std::string describe(const ChangeDescription& change) {
  const char* const plural = change.steps == 1 ? "" : "s";
  switch (change.kind) {
    case ChangeKind::start:
      return "start";
    case ChangeKind::paint:
      return "paint";
    case ChangeKind::erase:
      return "erase";
    case ChangeKind::target:
      return "T";
    case ChangeKind::range:
      return "range";
    case ChangeKind::smoothing:
      return "smoothing";
    case ChangeKind::parameters:
      return "parameters";
    case ChangeKind::evolution:
      return fmt::format("evolution, {} step{}", change.steps, plural);
    case ChangeKind::step_back:
      return fmt::format("{} step{} back", change.steps, plural);
    case ChangeKind::restart:
      return "restart";
    case ChangeKind::sweep:
      return fmt::format("run of a sweep, {} step{}", change.steps, plural);
    case ChangeKind::source:
      return "smoothing of the volume";
    case ChangeKind::examples:
      return "examples";
    case ChangeKind::constraints:
      return "walls and anchors";
    case ChangeKind::speed:
      return "speed function";
    case ChangeKind::new_label:
      return fmt::format("new label {}", change.name);
    case ChangeKind::label_settings:
      return fmt::format("settings of {}", change.name);
    case ChangeKind::remove_label:
      return fmt::format("remove {}", change.name);
    case ChangeKind::import_labels:
      return fmt::format("import of {}", change.name);
    case ChangeKind::accept:
      return fmt::format("accept into {}", change.name);
  }
  return {};
}

void History::set_limit(std::int64_t bytes) {
  limit_ = bytes;
  keep_below_limit();
}

std::int64_t History::bytes() const {
  std::int64_t sum = open_ != nullptr ? open_->bytes() : 0;
  for (const std::deque<Entry>* entries : {&done_, &undone_}) {
    for (const Entry& entry : *entries) sum += entry.change->bytes();
  }
  return sum;
}

void History::keep_below_limit() {
  std::int64_t sum = bytes();
  while (sum > limit_ && done_.size() > 1) {
    sum -= done_.front().change->bytes();
    base_id_ = done_.front().id;
    done_.pop_front();
  }
}

void History::add(ChangeDescription description, std::unique_ptr<Change> change) {
  undone_.clear();
  done_.push_back({std::move(description), std::move(change), ++last_id_});
  ++edits_;
  keep_below_limit();
}

void History::open(OpenChange& change) {
  undone_.clear();
  open_ = &change;
  ++last_id_;
}

Status History::close() {
  if (open_ == nullptr) return {};
  return std::exchange(open_, nullptr)->close();
}

Status History::undo() {
  TIDEMARK_TRY(close());
  if (done_.empty()) return fail(ErrorKind::usage, "there is nothing to undo");
  TIDEMARK_TRY(done_.back().change->undo());
  undone_.push_back(std::move(done_.back()));
  done_.pop_back();
  ++edits_;
  return {};
}

Status History::redo() {
  TIDEMARK_TRY(close());
  if (undone_.empty()) return fail(ErrorKind::usage, "there is nothing to redo");
  TIDEMARK_TRY(undone_.back().change->redo());
  done_.push_back(std::move(undone_.back()));
  undone_.pop_back();
  ++edits_;
  return {};
}

std::optional<ChangeDescription> History::undo_description() const {
  if (open_ != nullptr) return open_->description();
  if (done_.empty()) return std::nullopt;
  return done_.back().description;
}

std::optional<ChangeDescription> History::redo_description() const {
  if (undone_.empty()) return std::nullopt;
  return undone_.back().description;
}

std::uint64_t History::position() const {
  if (open_ != nullptr) return last_id_;  // entries get later numbers
  return done_.empty() ? base_id_ : done_.back().id;
}

}  // namespace tidemark::document
