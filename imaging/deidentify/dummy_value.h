// Values that say nothing and are right for their representation. Private to this folder.
#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcelem.h>

#include <memory>

namespace tidemark::imaging {

// An element of that tag and the data dictionary's representation, without a value. Throws std::bad_alloc.
[[nodiscard]] std::unique_ptr<DcmElement> empty_element(const DcmTagKey& key);

// The same with a value (DICOM PS3.5 6.2): "DUMMY", "20000101", "0", or two zero bytes (OB, UN). What is a
// number or a sequence has none.
[[nodiscard]] std::unique_ptr<DcmElement> dummy_element(const DcmTagKey& key);

}  // namespace tidemark::imaging
