// The figures of a case as a table for showing, copying and exporting. Measurements that are not complete
// are left out.
#pragma once

#include <QString>
#include <optional>
#include <string>
#include <vector>

#include "engine/case_state.h"
#include "engine/measurement.h"

namespace tidemark::engine {
class CaseProxy;
}

namespace tidemark::ui {

struct RegionRow {
  QString name;
  double volume_ml = 0.0;
  std::optional<double> area_mm2;  // of the surface alone
  std::int64_t voxels = 0;
  std::optional<document::RegionStatistics> values;  // of the source inside; none before it was measured
};

// The surface first, if there is one, then the labels.
std::vector<RegionRow> region_rows(const engine::CaseState& state);

// RFC 4180, numbers with a point in every locale and all digits that tell; no name depends on the language.
std::string to_csv(engine::CaseProxy& proxy);

// Columns parted by tabs, numbers as the user's language writes them: for spreadsheets and reports.
QString to_text(engine::CaseProxy& proxy);

QString kind_text(engine::Measurement::Kind kind);
QString unit_text(engine::Measurement::Kind kind);  // of its value

}  // namespace tidemark::ui
