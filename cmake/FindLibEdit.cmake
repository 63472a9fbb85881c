# libedit as the imported target LibEdit::LibEdit, LibEdit_VERSION its version.
#
# Debian's package has a file for pkg-config and none for CMake.
include(FindPackageHandleStandardArgs)

find_path(LibEdit_INCLUDE_DIR histedit.h)
find_library(LibEdit_LIBRARY edit)
mark_as_advanced(LibEdit_INCLUDE_DIR LibEdit_LIBRARY)
set(LibEdit_VERSION "")
if(LibEdit_INCLUDE_DIR)
  file(STRINGS ${LibEdit_INCLUDE_DIR}/histedit.h _libedit_version REGEX "^#define LIBEDIT_(MAJOR|MINOR) ")
  string(REGEX REPLACE ".*MAJOR +([0-9]+).*MINOR +([0-9]+).*" "\\1.\\2" LibEdit_VERSION "${_libedit_version}")
endif()
find_package_handle_standard_args(
  LibEdit
  REQUIRED_VARS LibEdit_LIBRARY LibEdit_INCLUDE_DIR
  VERSION_VAR LibEdit_VERSION)

if(LibEdit_FOUND AND NOT TARGET LibEdit::LibEdit)
  add_library(LibEdit::LibEdit UNKNOWN IMPORTED)
  set_target_properties(
    LibEdit::LibEdit PROPERTIES IMPORTED_LOCATION ${LibEdit_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES
                                                                     ${LibEdit_INCLUDE_DIR})
endif()
