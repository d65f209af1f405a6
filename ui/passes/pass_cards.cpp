#include "ui/passes/pass_cards.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <cmath>
#include <limits>
#include <utility>

#include "ui/look/theme.h"
#include "ui/passes/pass_text.h"

namespace tidemark::ui {
namespace {

using solver::PassRecord;

constexpr int kSide = PassRecord::kSide;
constexpr int kLarge = 126;  // of pictures, pixels of the unscaled screen
constexpr int kSlice = 96;
constexpr int kMiddle = 82;
constexpr int kSmall = 50;
constexpr int kBlocks = 40;
constexpr int kTitle = 60;  // of a row
constexpr float kNoTexel = std::numeric_limits<float>::quiet_NaN();

bool is_voxel(const PassRecord& record, int x, int y) {
  const Index3 valid = record.valid();
  return x < valid.x && y < valid.y;
}

// One value a texel of the page.
template <class Value>
TexelPicture::Content texels(const PassRecord& record, Value value) {
  TexelPicture::Content content;
  content.columns = content.rows = kSide;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x)
      content.values.push_back(is_voxel(record, x, y) ? static_cast<float>(value(x, y)) : kNoTexel);
  }
  content.range = round_range(content.values);
  const Index3 first = record.layout.first_voxel(record.page);
  content.place = [first](int x, int y) {
    return PassCards::tr("voxel %1, %2, %3").arg(first.x + x).arg(first.y + y).arg(first.z);
  };
  return content;
}

TexelPicture::Content channel(const PassRecord& record, const std::vector<glm::vec4>& buffer, int which) {
  return texels(record, [&](int x, int y) { return buffer[static_cast<std::size_t>(x + kSide * y)][which]; });
}

// With the neighbours' border, of a slice.
TexelPicture::Content bordered(const PassRecord& record, int slice) {
  TexelPicture::Content content;
  content.columns = static_cast<int>(record.valid().x) + 2;
  content.rows = static_cast<int>(record.valid().y) + 2;
  for (int y = -1; y < content.rows - 1; ++y) {
    for (int x = -1; x < content.columns - 1; ++x) content.values.push_back(record.phi_at(x, y, slice));
  }
  content.range = std::isfinite(record.band) ? record.band : round_range(content.values);
  content.border = 1;
  content.zero_line = true;
  const Index3 first = record.layout.first_voxel(record.page);
  content.place = [first, slice](int x, int y) {
    return PassCards::tr("voxel %1, %2, %3").arg(first.x + x - 1).arg(first.y + y - 1).arg(first.z + slice);
  };
  return content;
}

// Interior, -x, +x, -y, +y, and the corners. A page that the volume's border cuts is drawn as a smaller one.
int substream_of(const PassRecord& record, int x, int y) {
  const bool left = x == 0;
  const bool right = x == record.valid().x - 1;
  const bool top = y == 0;
  const bool bottom = y == record.valid().y - 1;
  if (top || bottom) {
    if (left) return top ? 5 : 7;
    if (right) return top ? 6 : 8;
    return top ? 3 : 4;
  }
  return left ? 1 : right ? 2 : 0;
}

TexelPicture::Content blocks(const std::vector<glm::vec4>& buffer, int which) {
  TexelPicture::Content content;
  content.columns = content.rows = PassRecord::kBlocks;
  for (const glm::vec4& block : buffer) content.values.push_back(block[which]);
  content.range = round_range(content.values) > 1e-6 ? round_range(content.values) : 1.0;
  content.names_range = false;
  return content;
}

}  // namespace

PassCards::PassCards(QWidget* parent) : CardColumns(parent) {
  add_address();
  add_substreams();
  add_derivatives();
  add_speeds();
  add_update();
  add_message();
}

QList<TexelPicture*> PassCards::add_row(PassCard& card, const QStringList& names, int side,
                                        const QString& title, const QString& tip) {
  QList<TexelPicture*> pictures;
  auto* row = new QHBoxLayout;
  row->setSpacing(kSpace - 2);
  if (!title.isEmpty()) {
    auto* label = new QLabel(title);
    label->setFont(caption_font(label->font()));
    label->setWordWrap(true);
    label->setFixedWidth(kTitle);
    label->setToolTip(tip);
    row->addWidget(label);
  }
  for (const QString& name : names) {
    pictures << new TexelPicture(name, side);
    row->addWidget(pictures.back());
  }
  row->addStretch(1);
  card.add(row);
  return pictures;
}

void PassCards::add_address() {
  auto* card =
      new PassCard(tr("Address translation"), tr("Fig. 5, 7"),
                   tr("The page table maps pages of the volume to tiles of the texture G; all others are one "
                      "of two static pages."));
  auto* row = new QHBoxLayout;
  virtual_pages_ = new PageMap(tr("Pages of this slice"));
  physical_pages_ = new PageMap(tr("Physical pages of G"));
  row->addWidget(virtual_pages_);
  row->addWidget(physical_pages_);
  card->add(row);
  address_ = card->add_line();
  add(card);
}

void PassCards::add_substreams() {
  auto* card = new PassCard(
      tr("φ and the nine substreams"), tr("Fig. 6"),
      tr("A texel at an edge or a corner reads from other pages than one in the interior, so that "
         "each of the nine is drawn with addresses of its own."));
  const auto pictures = add_row(*card, {tr("φ"), tr("Substreams")}, kLarge);
  phi_ = pictures[0];
  substreams_ = pictures[1];
  substreams_->setToolTip(
      tr("Interior, four edges, four corners: a quad, four lines and four points a page."));
  card->add_line()->setText(tr("The interior (grey) reads from 3 pages, an edge from 6, a corner from 12."));
  slices_ = add_row(*card, {tr("slice below"), tr("slice above")}, kSlice);
  add(card);
}

void PassCards::add_derivatives() {
  auto* card =
      new PassCard(tr("A: derivatives"), tr("Section 4.3"),
                   tr("The neighbourhood is gathered once. Its first and second differences go into four "
                      "buffers of four channels."));
  const QStringList names[] = {{tr("φ"), tr("|∇φ| out"), tr("|∇φ| in"), tr("product")},
                               {tr("2 φx"), tr("2 φy"), tr("2 φz"), tr("φ before")},
                               {tr("φxx"), tr("φyy"), tr("φzz")},
                               {tr("4 φxy"), tr("4 φxz"), tr("4 φyz")}};
  const QString titles[] = {tr("Upwind"), tr("Central"), tr("Second order"), tr("Mixed")};
  const QString tips[] = {tr("φ, the upwind gradient of a front that moves outward and of one that moves "
                             "inward, and the least product of φ "
                             "with a neighbour: below 0 beside the surface."),
                          tr("Twice the central first differences. The last channel takes along φ one step "
                             "earlier, where motion is "
                             "measured in this step."),
                          tr("The pure second differences."), tr("Four times the mixed second differences.")};
  for (std::size_t i = 0; i < differences_.size(); ++i)
    differences_[i] = add_row(*card, names[i], kSmall, titles[i], tips[i]);
  add(card);
}

void PassCards::add_speeds() {
  auto* card = new PassCard(
      tr("B: speed terms"), tr("Section 4.3"),
      tr("Each term of the equation, with its weight, in one channel: orange pushes outward, blue "
         "inward."));
  speeds_ = add_row(*card, {tr("data"), tr("curvature"), tr("rescaling"), tr("advection")}, kSmall);
  add(card);
}

void PassCards::add_update() {
  auto* card = new PassCard(
      tr("C: update"), tr("Section 4.3"),
      tr("The sum of the terms, times the time step, is added to φ; the result is clamped to ±W and "
         "written to the other texture."));
  update_ = add_row(*card, {tr("φ"), tr("new φ"), tr("change")}, kMiddle);
  add(card);
}

void PassCards::add_message() {
  auto* card = new PassCard(tr("The message"), tr("Fig. 8"),
                            tr("A: two buffers say where voxels differ. B: mipmaps reduce them to a texel a "
                               "page. C: that becomes a byte, D: on which the "
                               "processor acts."));
  across_[0] =
      add_row(*card, {face_name(0), face_name(1), face_name(2), face_name(3)}, kBlocks, tr("In slice"));
  across_[1] =
      add_row(*card, {face_name(4), face_name(5), tr("not in"), tr("not out")}, kBlocks, tr("Across slices"));
  bits_ = new MessageBits;
  code_ = card->add_line();
  card->add(bits_);
  decision_ = card->add_line();
  add(card);
}

void PassCards::show_record(const std::shared_ptr<const engine::RecordedStep>& recorded) {
  if (std::exchange(shown_, recorded) == recorded) return;
  if (!recorded) return clear();
  const PassRecord& record = recorded->record;
  show_address(record);
  if (!record.is_resident()) return clear();
  show_phi(record);
  show_steps(record);
  show_message(record);
}

void PassCards::clear() {
  for (TexelPicture* picture : findChildren<TexelPicture*>()) picture->clear();
  bits_->show_message({});
  code_->clear();
  decision_->clear();
}

void PassCards::show_address(const PassRecord& record) {
  address_->setText(address_text(record));
  const Index3 pages = record.layout.pages();
  const Index3 place = record.layout.page_coordinates(record.page);
  PageMap::Content slice;
  slice.columns = static_cast<int>(pages.x);
  for (const solver::PhysicalPage page : record.slice) {
    slice.pages.push_back(page == solver::kInsidePage    ? PageMap::Page::inside
                          : page == solver::kOutsidePage ? PageMap::Page::outside
                                                         : PageMap::Page::resident);
  }
  slice.chosen = static_cast<int>(place.x + pages.x * place.y);
  virtual_pages_->show_content(std::move(slice));
  PageMap::Content memory;
  memory.columns = static_cast<int>(record.memory_size.x / kSide);
  memory.pages.assign(static_cast<std::size_t>(memory.columns * (record.memory_size.y / kSide)),
                      PageMap::Page::unused);
  memory.pages[solver::kOutsidePage] = PageMap::Page::outside;
  memory.pages[solver::kInsidePage] = PageMap::Page::inside;
  for (std::size_t page = solver::kFirstPage; page < record.inverse.size() && page < memory.pages.size();
       ++page) {
    if (record.inverse[page] >= 0) memory.pages[page] = PageMap::Page::resident;
  }
  memory.chosen = record.physical;
  physical_pages_->show_content(std::move(memory));
}

void PassCards::show_phi(const PassRecord& record) {
  phi_->show_content(bordered(record, 0));
  slices_[0]->show_content(bordered(record, -1));
  slices_[1]->show_content(bordered(record, 1));
  TexelPicture::Content substreams = texels(record, [&](int x, int y) { return substream_of(record, x, y); });
  substreams.is_of_substreams = true;
  substreams_->show_content(std::move(substreams));
}

void PassCards::show_steps(const PassRecord& record) {
  for (std::size_t buffer = 0; buffer < differences_.size(); ++buffer) {
    for (int i = 0; i < differences_[buffer].size(); ++i)
      differences_[buffer][i]->show_content(channel(record, record.differences[buffer], i));
  }
  for (int i = 0; i < speeds_.size(); ++i) speeds_[i]->show_content(channel(record, record.speeds, i));
  const auto phi_of = [&](auto value) {
    TexelPicture::Content content = texels(record, value);
    if (std::isfinite(record.band)) content.range = record.band;
    content.zero_line = true;
    return content;
  };
  const auto before = [&](int x, int y) { return record.phi_at(x, y); };
  const auto after = [&](int x, int y) { return record.next[static_cast<std::size_t>(x + kSide * y)]; };
  update_[0]->show_content(phi_of(before));
  update_[1]->show_content(phi_of(after));
  update_[2]->show_content(texels(record, [&](int x, int y) { return after(x, y) - before(x, y); }));
}

void PassCards::show_message(const PassRecord& record) {
  for (int i = 0; i < 4; ++i) {
    across_[0][i]->show_content(blocks(record.across_in_slice, i));
    across_[1][i]->show_content(blocks(record.across_slices, i));
  }
  bits_->show_message(record.message);
  code_->setText(tr("C: the byte is %1.").arg(record.message.code));
  decision_->setText(tr("D: %1").arg(decision_text(record)));
}

}  // namespace tidemark::ui
