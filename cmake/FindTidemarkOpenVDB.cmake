# OpenVDB as the imported target OpenVDB::openvdb. The find module that OpenVDB installs looks for more than
# we use and prints a long warning about Imath's Python module where that is not installed; this one looks
# for the headers, the library and the two libraries whose headers OpenVDB's own include.
find_path(OpenVDB_INCLUDE_DIR openvdb/openvdb.h)
find_library(OpenVDB_LIBRARY openvdb)
mark_as_advanced(OpenVDB_INCLUDE_DIR OpenVDB_LIBRARY)

set(_openvdb_required OpenVDB_LIBRARY OpenVDB_INCLUDE_DIR TBB_FOUND)
find_package(TBB QUIET CONFIG)

if(OpenVDB_INCLUDE_DIR)
  file(STRINGS ${OpenVDB_INCLUDE_DIR}/openvdb/version.h _openvdb_lines REGEX "^#define OPENVDB_")
  foreach(_part MAJOR MINOR PATCH)
    if("${_openvdb_lines}" MATCHES "OPENVDB_LIBRARY_${_part}_VERSION_NUMBER ([0-9]+)")
      set(_openvdb_${_part} ${CMAKE_MATCH_1})
    endif()
  endforeach()
  set(OpenVDB_VERSION ${_openvdb_MAJOR}.${_openvdb_MINOR}.${_openvdb_PATCH})
  # With this, OpenVDB's half is Imath's, whose header is then needed wherever OpenVDB's are.
  if("${_openvdb_lines}" MATCHES "OPENVDB_USE_IMATH_HALF")
    find_path(Imath_INCLUDE_DIR half.h PATH_SUFFIXES Imath)
    file(GLOB _imath_names RELATIVE /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}
         /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/libImath-*.so)
    find_library(Imath_LIBRARY NAMES Imath ${_imath_names})
    mark_as_advanced(Imath_INCLUDE_DIR Imath_LIBRARY)
    list(APPEND _openvdb_required Imath_INCLUDE_DIR Imath_LIBRARY)
  endif()
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(TidemarkOpenVDB REQUIRED_VARS ${_openvdb_required}
                                  VERSION_VAR OpenVDB_VERSION)

if(TidemarkOpenVDB_FOUND AND NOT TARGET OpenVDB::openvdb)
  add_library(OpenVDB::openvdb SHARED IMPORTED)
  set_target_properties(OpenVDB::openvdb PROPERTIES
    IMPORTED_LOCATION ${OpenVDB_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES "${OpenVDB_INCLUDE_DIR};${Imath_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "TBB::tbb;${Imath_LIBRARY}")
endif()
