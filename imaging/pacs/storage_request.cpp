#include "imaging/pacs/storage_request.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcostrmf.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmnet/dimse.h>

#include <memory>

#include "imaging/pacs/storage_classes.h"

namespace tidemark::imaging {
namespace {

// Checks an object piece by piece as it comes. DCMTK has no way to stop: the connection is shut.
struct Growth {
  ConnectionWatch& watch;
  RetrievalFolder& retrieval_folder;
  unsigned long counted = 0;

  static void note(void* growth, unsigned long bytes) {
    auto& self = *static_cast<Growth*>(growth);
    const Status allowed = self.retrieval_folder.grown(static_cast<std::int64_t>(bytes - self.counted));
    self.counted = bytes;
    if (!allowed) self.watch.shut({allowed.error().kind, self.watch.peer() + ": " + allowed.error().message});
  }
};

Status receive_into(const std::filesystem::path& object, Association& association, int context,
                    const T_DIMSE_C_StoreRQ& request, RetrievalFolder& retrieval_folder,
                    const PacsLimits& limits) {
  ConnectionWatch& watch = association.watch();
  DcmOutputFileStream* opened = nullptr;
  const OFCondition created =
      DIMSE_createFilestream(object.c_str(), &request, association.get(),
                             static_cast<T_ASC_PresentationContextID>(context), 1, &opened);
  const std::unique_ptr<DcmOutputFileStream> stream(opened);
  if (created.bad())
    return fail(ErrorKind::write, "{}: cannot be written", retrieval_folder.folder().string());
  watch.allow(limits.object_bytes, "an object");
  Growth growth{watch, retrieval_folder};
  T_ASC_PresentationContextID data_context = 0;
  const OFCondition received = DIMSE_receiveDataSetInFile(association.get(), DIMSE_BLOCKING, 0, &data_context,
                                                          stream.get(), Growth::note, &growth);
  if (received.good() && data_context == context && stream->good()) {
    watch.completed_message();
    return {};
  }
  TIDEMARK_TRY(watch.trouble());
  if (!stream->good())
    return fail(ErrorKind::write, "{}: cannot be written", retrieval_folder.folder().string());
  return tl::unexpected<Error>(association.error(received, "breaks off in the midst of an object"));
}

Status respond(Association& association, int context, const T_DIMSE_C_StoreRQ& request,
               std::uint16_t status) {
  T_DIMSE_Message message{};
  message.CommandField = DIMSE_C_STORE_RSP;
  T_DIMSE_C_StoreRSP& response = message.msg.CStoreRSP;
  response.MessageIDBeingRespondedTo = request.MessageID;
  response.DimseStatus = status;
  response.DataSetType = DIMSE_DATASET_NULL;
  OFStandard::strlcpy(response.AffectedSOPClassUID, request.AffectedSOPClassUID, sizeof(DIC_UI));
  OFStandard::strlcpy(response.AffectedSOPInstanceUID, request.AffectedSOPInstanceUID, sizeof(DIC_UI));
  response.opts = O_STORE_AFFECTEDSOPCLASSUID | O_STORE_AFFECTEDSOPINSTANCEUID;
  return association.send(context, message);
}

}  // namespace

Status answer_storage_request(Association& association, int context, const T_DIMSE_Message& request,
                              RetrievalFolder& retrieval_folder, const PacsLimits& limits) {
  const T_DIMSE_C_StoreRQ& store = request.msg.CStoreRQ;
  auto object = retrieval_folder.next_object();
  if (!object) return fail(object.error().kind, "{}: {}", association.watch().peer(), object.error().message);
  const std::string sop_class = store.AffectedSOPClassUID;
  const bool is_agreed = sop_class == association.abstract_syntax(context) && is_storage_class(sop_class);
  Status received = receive_into(*object, association, context, store, retrieval_folder, limits);
  if (!received) return received;
  if (!is_agreed) {
    retrieval_folder.refuse(*object, "is of a class that was not asked for");
    return respond(association, context, store, STATUS_STORE_Refused_SOPClassNotSupported);
  }
  const bool taken = retrieval_folder.take(*object, {{sop_class, store.AffectedSOPInstanceUID}});
  return respond(association, context, store,
                 taken ? STATUS_Success : STATUS_STORE_Error_DataSetDoesNotMatchSOPClass);
}

}  // namespace tidemark::imaging
