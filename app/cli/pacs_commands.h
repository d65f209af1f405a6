// The commands under tidemark-cli pacs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/cli/program.h"
#include "app/cli/server_choice.h"
#include "imaging/pacs/services.h"

namespace tidemark::cli {

struct ChosenPacs {
  imaging::PacsServer server;
  imaging::PacsLimits limits;
};
// Of pacs_configuration_file() where no file was chosen.
Result<ChosenPacs> chosen_pacs(const ServerChoice& choice);

// The keys of a query for studies. `of_studies` alone make no sense for the series of a study.
struct StudyKeys {
  std::vector<CLI::Option*> all, of_studies;
};
StudyKeys add_study_keys(CLI::App& command, imaging::StudyQuery& query, const char* of_description);

void add_pacs_find(CLI::App& pacs, Program& program);
void add_pacs_get(CLI::App& pacs, Program& program);
void add_pacs_send(CLI::App& pacs, Program& program);

}  // namespace tidemark::cli
