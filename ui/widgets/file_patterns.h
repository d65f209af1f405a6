// The names of files that can be opened, for the filters of file dialogs.
#pragma once

namespace tidemark::ui {

// Volume files and pictures (imaging/files/volume_file.h).
inline constexpr const char* kVolumePatterns =
    "*.nii *.nii.gz *.nrrd *.nhdr *.mha *.mhd *.gipl *.gipl.gz *.png *.jpg *.jpeg *.tif *.tiff";

}  // namespace tidemark::ui
