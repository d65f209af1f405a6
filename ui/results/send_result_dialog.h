// The dialog that sends results to a server.
#pragma once

#include <QCheckBox>
#include <filesystem>

#include "engine/pacs_client.h"
#include "ui/pacs/server_choice.h"
#include "ui/results/result_dialog.h"

namespace tidemark::ui {

class SendResultDialog : public ResultDialog {
  Q_OBJECT
 public:
  // `servers` is the file of servers.
  SendResultDialog(CaseWindow& window, std::filesystem::path servers);

 protected:
  [[nodiscard]] bool ready() const override;
  void begin(const Snapshot& snapshot) override;
  void give_up() override { client_.cancel(); }

 private:
  QWidget* make_target();
  void tell(const imaging::Sent& sent);

  engine::PacsClient client_;
  QString receiver_;  // the server that gets it now
  ServerChoice* servers_;
  QCheckBox* segmentation_;
  QCheckBox* contours_;
  QCheckBox* report_;      // about the segmentation
  QCheckBox* key_images_;  // with their presentation state
};

}  // namespace tidemark::ui
