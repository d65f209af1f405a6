#include "study/label_segments.h"

namespace tidemark {

Segments segments_of(const Labels& labels) {
  Segments segments{labels.geometry(), {}, {}};
  for (const Label& label : labels.list()) {
    Segment segment;
    segment.name = label.name;
    segment.colour = label.colour;
    segment.slices = slices_of(labels.geometry(), labels.voxels(), label.id);
    segments.list.push_back(std::move(segment));
  }
  return segments;
}

Status add_segments(Labels& labels, const Segments& segments) {
  if (segments.geometry.size != labels.geometry().size) {
    return fail(ErrorKind::usage, "the segments and the labels have different grids");
  }
  if (labels.list().size() + segments.list.size() > 255) {
    return fail(ErrorKind::usage, "{} segments and the {} labels there are make more than 255",
                segments.list.size(), labels.list().size());
  }
  for (const Segment& segment : segments.list) {
    const auto id = labels.add(segment.name);
    if (!id) return tl::unexpected<Error>(id.error());
    Label label = *labels.find(*id);
    label.colour = segment.colour.value_or(label.colour);
    if (auto set = labels.set(label); !set) return set;
    Segments one{segments.geometry, {segment}, {}};
    if (auto accepted = labels.accept(union_of(one), *id); !accepted) return accepted;
  }
  return {};
}

}  // namespace tidemark
