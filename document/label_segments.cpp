#include "document/label_segments.h"

#include <algorithm>
#include <array>

#include "core/label_colour.h"

namespace tidemark::document {
namespace {

constexpr std::size_t kLongestText = 64;  // bytes, as other systems have it (DICOM's LO)

// Cuts between characters of UTF-8.
std::string shortened(std::string text) {
  std::size_t length = std::min(text.size(), kLongestText);
  while (length > 0 && length < text.size() && (static_cast<unsigned char>(text[length]) & 0xC0U) == 0x80U) {
    --length;
  }
  text.resize(length);
  return text;
}

bool makes_sense(const imaging::Code& code) {
  constexpr std::size_t kLongestValue = 16;  // of a DICOM SH
  return !code.value.empty() && code.value.size() <= kLongestValue && !code.scheme.empty() &&
         code.scheme.size() <= kLongestValue && !code.meaning.empty() && code.meaning.size() <= kLongestText;
}

// Files without a better meaning have "tissue"; the name may then have more.
std::optional<imaging::SegmentMeaning> meaning_in(const imaging::Segment& segment) {
  const imaging::SegmentMeaning& meaning = segment.meaning;
  if (meaning == imaging::SegmentMeaning() || !makes_sense(meaning.category) || !makes_sense(meaning.type)) {
    return std::nullopt;
  }
  return meaning;
}

// Which ids are taken, and by labels that keep their voxels.
struct Taken {
  std::array<bool, 256> id{true};
  std::array<bool, 256> locked{};

  explicit Taken(const std::vector<Label>& list) {
    for (const Label& label : list) {
      id[label.id] = true;
      locked[label.id] = label.locked;
    }
  }
  std::uint8_t next() {
    const auto free = std::find(id.begin(), id.end(), false);
    *free = true;
    return static_cast<std::uint8_t>(free - id.begin());
  }
};

void give_voxels(const imaging::Segment& segment, std::uint8_t id, const Taken& taken, PagedBytes& voxels) {
  const std::int64_t width = voxels.size().x;
  std::vector<std::uint8_t> ids(static_cast<std::size_t>(width));
  for (const auto& [k, slice] : segment.slices) {
    for (std::int64_t j = 0; j < voxels.size().y; ++j) {
      voxels.read({0, j, k}, {width, 1, 1}, ids.data());
      const auto gets = [&, row = slice.data() + width * j](std::int64_t i) {
        return row[i] != 0 && !taken.locked[ids[static_cast<std::size_t>(i)]];
      };
      for (std::int64_t i = 0; i < width; ++i) {
        const std::int64_t begin = i;
        while (i < width && gets(i)) ++i;
        if (i > begin) voxels.fill({begin, j, k}, {i - begin, 1, 1}, id);
      }
    }
  }
}

}  // namespace

imaging::Segments segments_of(const Geometry& geometry, std::span<const Label> labels,
                              const PagedBytes& voxels) {
  imaging::Segments segments{geometry, {}, {}};
  for (const Label& label : labels) {
    imaging::Segment segment;
    segment.name = label.name;
    segment.colour = label.colour;
    segment.meaning = label.coded();
    segment.slices = imaging::slices_of(voxels, label.id);
    segments.list.push_back(std::move(segment));
  }
  return segments;
}

imaging::Segments segments_of(const Labels& labels) {
  return segments_of(labels.geometry(), labels.list(), labels.voxels());
}

Status add_segments(Labels& labels, const imaging::Segments& segments) {
  if (segments.geometry.size != labels.geometry().size) {
    return fail(ErrorKind::usage, "the segments and the labels have different grids");
  }
  if (labels.list().size() + segments.list.size() > 255) {
    return fail(ErrorKind::usage, "{} segments and the {} labels there are make more than 255",
                segments.list.size(), labels.list().size());
  }
  std::vector<Label> list = labels.list();
  PagedBytes voxels = labels.voxels();
  Taken taken(list);
  std::string names;
  for (const imaging::Segment& segment : segments.list) {
    Label label;
    label.id = taken.next();
    label.name = shortened(segment.name);
    label.colour = segment.colour.value_or(label_colour(label.id));
    label.meaning = meaning_in(segment);
    give_voxels(segment, label.id, taken, voxels);
    names += (names.empty() ? "" : ", ") + label.name;
    list.push_back(std::move(label));
  }
  return labels.replace(ChangeKind::import_labels, names, std::move(list), std::move(voxels));
}

}  // namespace tidemark::document
