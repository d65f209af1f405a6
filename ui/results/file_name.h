// What files of a case are called unless somebody says otherwise.
#pragma once

#include <QString>

namespace tidemark {

struct LoadedStudy;

// The series' name without what has no place in names of files; its modality and date where the name tells
// who the patient is. Without an ending.
QString file_name_of(const LoadedStudy& study);

}  // namespace tidemark
