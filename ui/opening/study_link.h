// Links by which other programs open a study: tidemark://…
#pragma once

#include <QString>

#include "core/result.h"
#include "imaging/pacs/services.h"

namespace tidemark::ui {

// What a link names: a file or folder of this machine, or a study that a server is asked for.
struct StudyLink {
  QString path;    // empty: a server is asked
  QString server;  // its name; empty: the one that was asked last
  imaging::StudyQuery query;

  [[nodiscard]] static bool is_link(const QString& text);
  // tidemark://open?path=/data/ct
  // tidemark://study?uid=1.2.840.99.7&server=main
  // tidemark://IHEInvokeImageDisplay?requestType=STUDY&studyUID=1.2.840.99.7, or
  //   requestType=PATIENT&patientID=4711 (IHE Radiology, Invoke Image Display, RAD-106)
  // Names of parameters are read in any case, and those that are not known are ignored. Fails
  // (ErrorKind::usage), naming what is missing or wrong.
  static Result<StudyLink> parse(const QString& text);
};

}  // namespace tidemark::ui
