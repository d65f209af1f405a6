#include "ui/results/send_result_dialog.h"

#include <QGridLayout>

#include "engine/message_text.h"
#include "imaging/results/key_images.h"
#include "ui/look/theme.h"

namespace tidemark::ui {
namespace {

// What is sent beside the segments.
struct Wanted {
  std::vector<imaging::ResultForm> forms;
  std::shared_ptr<const Volume>
      measured;  // its values go into a report about the segmentation; null: no report
  std::shared_ptr<const Volume> key_images_of;  // null: none
  WindowLevel window;                           // of the key images
};

// Each form as a file of its own in that folder, and the report.
Result<std::vector<std::filesystem::path>> write_forms(const document::SessionContents& contents,
                                                       document::ResultContent content, const Wanted& wanted,
                                                       const std::vector<std::filesystem::path>& source,
                                                       const std::filesystem::path& folder,
                                                       const Progress& progress) {
  const auto segments = document::result_segments(contents, content);
  if (!segments) return pass_on(segments);
  std::vector<std::filesystem::path> files;
  std::filesystem::path segmentation;
  const auto count =
      static_cast<int>(wanted.forms.size()) + (wanted.measured ? 1 : 0) + (wanted.key_images_of ? 1 : 0);
  for (const imaging::ResultForm form : wanted.forms) {
    const auto number = static_cast<int>(files.size());
    files.push_back(folder / fmt::format("{}.dcm", number + 1));
    if (form == imaging::ResultForm::segmentation) segmentation = files.back();
    const Status written =
        document::write_result(*segments, form, source, files.back(), progress.part(number, count));
    if (!written) return pass_on(written);
  }
  if (wanted.measured) {
    const auto number = static_cast<int>(files.size());
    files.push_back(folder / "report.dcm");
    const Status written = document::write_measurements(*segments, wanted.measured, segmentation,
                                                        files.back(), progress.part(number, count));
    if (!written) return pass_on(written);
  }
  if (wanted.key_images_of) {
    const auto window = imaging::window_of_files(*wanted.key_images_of, wanted.window);
    imaging::KeyImageFiles key{folder / "key.dcm", folder / "outlines.dcm"};
    const auto write = [&] {
      return imaging::write_key_images(*segments, source, window, imaging::kKeyImageNote, key,
                                       progress.part(static_cast<int>(files.size()), count));
    };
    Status written = write();
    // What no one state can show is named all the same.
    if (!written && written.error().kind == ErrorKind::input) {
      key.presentation.clear();
      written = write();
    }
    if (!written) return pass_on(written);
    if (!key.presentation.empty()) files.push_back(key.presentation);
    files.push_back(key.selection);
  }
  return files;
}

}  // namespace

SendResultDialog::SendResultDialog(CaseWindow& window, std::filesystem::path servers)
    : ResultDialog(window, tr("Send a segmentation to a server")),
      servers_(new ServerChoice(std::move(servers), tr("The server that gets the result"), this)),
      segmentation_(new QCheckBox(tr("&Segmentation (SEG)"), this)),
      contours_(new QCheckBox(tr("Contours (&RT structure set)"), this)),
      report_(new QCheckBox(tr("&Measurements (SR)"), this)),
      key_images_(new QCheckBox(tr("&Key images (KO, with outlines)"), this)) {
  build(true, make_target(), source_note(proxy().study()), tr("Se&nd"),
        tr("Sends the case in its present state"));
  connect(&client_, &engine::PacsClient::progressed, &work(), &WorkLine::set_progress);
  connect(&client_, &engine::PacsClient::failed, this, &SendResultDialog::rest);
  connect(&client_, &engine::PacsClient::cancelled, this,
          [this] { rest(tr("Cancelled. What the server has taken by then stays there.")); });
  connect(&client_, &engine::PacsClient::sent, this, [this](const auto& sent) { tell(*sent); });
  for (QCheckBox* form : {segmentation_, contours_, key_images_})
    connect(form, &QCheckBox::toggled, this, &SendResultDialog::follow);
  connect(segmentation_, &QCheckBox::toggled, report_, &QCheckBox::setEnabled);
  connect(servers_, &ServerChoice::chosen, this, &SendResultDialog::follow);
  connect(servers_, &ServerChoice::edited, this, [this] { rest(servers_->problem()); });
  rest(servers_->problem());
}

QWidget* SendResultDialog::make_target() {
  auto* target = new QWidget(this);
  auto* grid = new QGridLayout(target);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(kSpace);
  grid->setVerticalSpacing(kSpaceTight);
  segmentation_->setChecked(true);
  segmentation_->setToolTip(tr("The voxels of each segment, as other viewers show them"));
  contours_->setToolTip(tr("Closed contours slice by slice, as systems for planning want them"));
  report_->setToolTip(
      tr("A structured report with the volume and the diameters of each segment, and the values inside. It "
         "refers "
         "to the segmentation."));
  key_images_->setToolTip(
      tr("Names the image in which each segment is largest, and shows it with the window of the views and "
         "the segment's outline"));
  key_images_->setEnabled(!proxy().study().dicom_files.empty());
  auto* form = new QLabel(tr("As"), target);
  auto* label = new QLabel(tr("&To"), target);
  label->setBuddy(servers_);
  grid->addWidget(form, 0, 0);
  grid->addWidget(segmentation_, 0, 1);
  grid->addWidget(contours_, 1, 1);
  grid->addWidget(report_, 2, 1);
  grid->addWidget(key_images_, 3, 1);
  grid->addWidget(label, 4, 0);
  grid->addWidget(servers_, 4, 1);
  grid->setColumnStretch(1, 1);
  return target;
}

bool SendResultDialog::ready() const {
  return servers_->server() != nullptr &&
         (segmentation_->isChecked() || contours_->isChecked() || key_images_->isChecked());
}

void SendResultDialog::begin(const Snapshot& snapshot) {
  const imaging::PacsServer& server = *servers_->server();
  receiver_ = QString::fromStdString(server.name);
  servers_->remember();
  Wanted wanted;
  if (segmentation_->isChecked()) wanted.forms.push_back(imaging::ResultForm::segmentation);
  if (contours_->isChecked()) wanted.forms.push_back(imaging::ResultForm::structure_set);
  if (segmentation_->isChecked() && report_->isChecked()) wanted.measured = proxy().study().volume;
  if (key_images_->isChecked()) wanted.key_images_of = proxy().study().volume;
  wanted.window = proxy().display().settings().window;
  client_.send(server, [snapshot, wanted, what = content(), source = proxy().study().dicom_files](
                           const std::filesystem::path& folder, const Progress& progress) {
    return write_forms(snapshot->contents, what, wanted, source, folder, progress);
  });
}

void SendResultDialog::tell(const imaging::Sent& sent) {
  if (!sent.unsent.empty()) {
    return rest(tr("%1 did not take all of it: %2.")
                    .arg(receiver_, engine::message_text(sent.unsent.front().reason)));
  }
  const bool of_study = !proxy().study().dicom_files.empty();
  if (of_study && sent.objects > 1) {
    return rest(
        tr("%1 has it, as %2 new series of this study.").arg(receiver_, QString::number(sent.objects)));
  }
  const QString text = of_study           ? tr("%1 has it, as a new series of this study.")
                       : sent.objects > 1 ? tr("%1 has it, as new studies of an anonymous patient.")
                                          : tr("%1 has it, as a new study of an anonymous patient.");
  rest(text.arg(receiver_));
}

}  // namespace tidemark::ui
