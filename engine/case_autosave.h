// Copies of a case's unsaved changes.
#pragma once

#include <QObject>
#include <QPointer>
#include <QTimer>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "document/autosave.h"
#include "engine/case_proxy.h"

namespace tidemark::engine {

class BackgroundJob;

// Written every kInterval or kEdits edits, away from the user interface. An open change goes on. A program
// that dies leaves the last copy behind, for find_recoverable().
class CaseAutosave : public QObject {
  Q_OBJECT
 public:
  static constexpr std::chrono::seconds kInterval{30};
  static constexpr std::uint64_t kEdits = 50;

  // `view_state`: how the case is shown, asked for at each copy.
  CaseAutosave(CaseProxy& proxy, std::filesystem::path folder, std::function<std::string()> view_state,
               std::chrono::milliseconds interval = kInterval);
  // The case was closed because the user wanted it: nothing is left behind, unless it could not go on.
  ~CaseAutosave() override;

  void save_now();
  // Another way to ask how the case is shown.
  void ask_view_state_of(std::function<std::string()> view_state) { view_state_ = std::move(view_state); }
  // With the case's first state at the latest: a rescued case is in no file but the copy that it came from.
  void save_soon();

 signals:
  void saved();
  void failed(const QString& message);  // of copies that fail one after the other, the first

 private:
  struct Copies;
  // What differs between two copies.
  struct Copied {
    std::uint64_t edits = 0;
    std::int64_t step = -1;  // there is no copy yet
    // An open change goes on without another edit.
    std::uint64_t steered = 0;
    solver::Parameters parameters = {};
    document::Drive drive = {};
    Attachments attachments;

    bool operator==(const Copied&) const = default;
  };

  [[nodiscard]] Copied present() const;
  void follow();
  void copied(const Status& status);

  CaseProxy& proxy_;
  std::function<std::string()> view_state_;
  std::shared_ptr<Copies> copies_;
  std::shared_ptr<BackgroundJob> job_;
  QTimer timer_;
  Copied last_;
  bool soon_ = false;
  bool writing_ = false;
  bool was_modified_ = false;
  bool fails_ = false;  // the last copy could not be written
  bool keeps_ = false;  // the copy, as the case cannot go on
};

// Where copies are, for all cases of this user.
std::filesystem::path recovery_folder();

}  // namespace tidemark::engine
