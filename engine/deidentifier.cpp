#include "engine/deidentifier.h"

#include <algorithm>

#include "core/files_below.h"

namespace tidemark::engine {
namespace {

using Outcome = std::shared_ptr<const DeidentifyOutcome>;

Result<Outcome> carry_out(DeidentifyOrder order, const Progress& progress) {
  if (order.files.empty()) {
    auto found = files_below(order.places.source, progress);
    if (!found) return pass_on(found);
    order.files = std::move(*found);
  }
  order.options.record = imaging::RecordedChanges::totals;
  auto written = imaging::write_deidentified(order.files, order.places, order.options, progress);
  if (!written) return pass_on(written);
  auto outcome = std::make_shared<DeidentifyOutcome>();
  outcome->files = written->files.size();
  outcome->series = written->series;
  outcome->patients = written->patients.size();
  outcome->changes = std::move(written->totals);
  for (const imaging::DeidentifiedFile& file : written->files) {
    if (!file.risk.empty()) outcome->risky.emplace_back(file.source, file.risk);
  }
  outcome->left_out = std::move(written->left_out);
  std::erase_if(outcome->left_out, [](const imaging::LeftOutFile& file) {
    return file.kind == imaging::LeftOutFile::Kind::not_dicom;
  });
  return outcome;
}

}  // namespace

Deidentifier::Deidentifier(QObject* parent) : JobRunner(parent) {}

void Deidentifier::write(const DeidentifyOrder& order) {
  run([order](const Progress& progress) { return carry_out(order, progress); },
      [this](const Outcome& outcome) { emit written(outcome); });
}

}  // namespace tidemark::engine
