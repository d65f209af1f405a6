// Results sent to a server.
#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <filesystem>

#include "session/pacs_client.h"
#include "ui/results/result_dialog.h"

namespace tidemark {

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
  void read_servers();
  void edit_servers();
  void tell(const Sent& sent);

  std::filesystem::path file_;
  PacsConfiguration configuration_;
  PacsClient client_;
  QString receiver_;  // the server that gets it now
  QComboBox* server_;
  QCheckBox* segmentation_;
  QCheckBox* contours_;
};

}  // namespace tidemark
