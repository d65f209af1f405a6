#include "app/cli/sweep_files.h"

#include "core/csv.h"

namespace tidemark::cli {
namespace {

// The values of the run's axes, the first one first.
std::vector<double> values_of(const document::Sweep& sweep, int column, int row) {
  std::vector<double> values{sweep.axes.front().value(column)};
  if (sweep.axes.size() > 1) values.push_back(sweep.axes.back().value(row));
  return values;
}

template <class Visit>
void for_each_run(const document::Sweep& sweep, const Visit& visit) {
  for (int row = 0; row < sweep.rows(); ++row) {
    for (int column = 0; column < sweep.columns(); ++column) visit(column, row, sweep.at(column, row));
  }
}

}  // namespace

std::string sweep_table(const document::Sweep& sweep) {
  std::string text;
  for (const document::SweepAxis& axis : sweep.axes) text += axis.parameter + ",";
  text += "steps,converged,outcome,volume_ml,voxels_inside,dice,problem\n";
  for_each_run(sweep, [&](int column, int row, const document::SweepRun& run) {
    for (const double value : values_of(sweep, column, row)) text += fmt::format("{},", value);
    text += fmt::format("{},{},{},{},{},{},{}\n", run.steps, run.converged ? "yes" : "no",
                        document::name_of(run.outcome), run.volume_ml, run.inside.count(),
                        run.dice ? fmt::format("{}", *run.dice) : std::string(), csv_field(run.problem));
  });
  return text;
}

Json sweep_json(const document::Sweep& sweep) {
  Json object;
  for (const document::SweepAxis& axis : sweep.axes) {
    Json values = Json::array();
    for (int i = 0; i < axis.count; ++i) values.push_back(axis.value(i));
    object["axes"].push_back({{"parameter", axis.parameter}, {"values", std::move(values)}});
  }
  for_each_run(sweep, [&](int column, int row, const document::SweepRun& run) {
    Json one;
    one["values"] = values_of(sweep, column, row);
    one["steps"] = run.steps;
    one["converged"] = run.converged;
    one["outcome"] = document::name_of(run.outcome);
    one["volume_ml"] = run.volume_ml;
    one["voxels_inside"] = run.inside.count();
    if (run.dice) one["dice"] = *run.dice;
    if (!run.problem.empty()) one["problem"] = run.problem;
    object["runs"].push_back(std::move(one));
  });
  return object;
}

}  // namespace tidemark::cli
