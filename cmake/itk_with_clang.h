// A header that clang reads before everything that includes ITK; the fuzz targets need clang.
// Debian's ITK was configured for g++ alone, and the file below refuses every other compiler: clang passes
// for g++ in it.
#pragma GCC system_header
#pragma push_macro("__clang__")
#pragma push_macro("__GNUC__")
#pragma push_macro("__GNUC_MINOR__")
#undef __clang__
#undef __GNUC__
#undef __GNUC_MINOR__
#define __GNUC__ 12
#define __GNUC_MINOR__ 2
#include <itk_compiler_detection.h>
#pragma pop_macro("__GNUC_MINOR__")
#pragma pop_macro("__GNUC__")
#pragma pop_macro("__clang__")
