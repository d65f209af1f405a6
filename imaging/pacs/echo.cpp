#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmnet/dimse.h>

#include "core/stopwatch.h"
#include "core/without_exceptions.h"
#include "imaging/pacs/association.h"
#include "imaging/pacs/services.h"
#include "imaging/pacs/web/web_services.h"

namespace tidemark::imaging {
namespace {

Result<double> echo(const PacsServer& server, const Progress& progress) {
  progress(0.0, "calling the server");
  const Proposal verification{
      UID_VerificationSOPClass,
      {UID_LittleEndianExplicitTransferSyntax, UID_LittleEndianImplicitTransferSyntax}};
  auto opened = Association::open(server, {verification}, progress.stop);
  if (!opened) return pass_on(opened);
  Association& association = **opened;
  const int context = association.context(UID_VerificationSOPClass);

  const Stopwatch stopwatch;
  T_DIMSE_Message request{};
  request.CommandField = DIMSE_C_ECHO_RQ;
  request.msg.CEchoRQ.MessageID = association.next_message_id();
  request.msg.CEchoRQ.DataSetType = DIMSE_DATASET_NULL;
  OFStandard::strlcpy(request.msg.CEchoRQ.AffectedSOPClassUID, UID_VerificationSOPClass, sizeof(DIC_UI));
  TIDEMARK_TRY(association.send(context, request));
  T_DIMSE_Message answer{};
  auto received = association.receive(answer);
  if (!received) return pass_on(received);
  if (answer.CommandField != DIMSE_C_ECHO_RSP || answer.msg.CEchoRSP.DimseStatus != STATUS_Success) {
    return fail(ErrorKind::input, "{}: does not echo", association.watch().peer());
  }
  const double seconds = stopwatch.seconds();
  association.release();
  return seconds;
}

}  // namespace

Result<double> pacs_echo(const PacsServer& server, const Progress& progress) {
  return without_exceptions(
      [&] { return server.web ? echo_by_web(server, progress) : echo(server, progress); });
}

}  // namespace tidemark::imaging
