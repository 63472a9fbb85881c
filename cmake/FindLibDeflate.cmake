# libdeflate as the imported target LibDeflate::LibDeflate, LibDeflate_VERSION its version.
#
# Debian's package has a file for pkg-config and none for CMake.
include(FindPackageHandleStandardArgs)

find_path(LibDeflate_INCLUDE_DIR libdeflate.h)
find_library(LibDeflate_LIBRARY deflate)
mark_as_advanced(LibDeflate_INCLUDE_DIR LibDeflate_LIBRARY)
set(LibDeflate_VERSION "")
if(LibDeflate_INCLUDE_DIR)
  file(STRINGS ${LibDeflate_INCLUDE_DIR}/libdeflate.h _libdeflate_version REGEX "^#define LIBDEFLATE_VERSION_STRING")
  string(REGEX REPLACE ".*\"([0-9.]+)\".*" "\\1" LibDeflate_VERSION "${_libdeflate_version}")
endif()
find_package_handle_standard_args(
  LibDeflate
  REQUIRED_VARS LibDeflate_LIBRARY LibDeflate_INCLUDE_DIR
  VERSION_VAR LibDeflate_VERSION)

if(LibDeflate_FOUND AND NOT TARGET LibDeflate::LibDeflate)
  add_library(LibDeflate::LibDeflate UNKNOWN IMPORTED)
  set_target_properties(
    LibDeflate::LibDeflate PROPERTIES IMPORTED_LOCATION ${LibDeflate_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES
                                                                              ${LibDeflate_INCLUDE_DIR})
endif()
