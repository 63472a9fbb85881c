# PCRE2 for 8-bit text as the imported target Pcre2::Pcre2, Pcre2_VERSION its version.
#
# Debian's package has a file for pkg-config and none for CMake.
include(FindPackageHandleStandardArgs)

find_path(Pcre2_INCLUDE_DIR pcre2.h)
find_library(Pcre2_LIBRARY pcre2-8)
mark_as_advanced(Pcre2_INCLUDE_DIR Pcre2_LIBRARY)
set(Pcre2_VERSION "")
if(Pcre2_INCLUDE_DIR)
  file(STRINGS ${Pcre2_INCLUDE_DIR}/pcre2.h _pcre2_version REGEX "^#define PCRE2_(MAJOR|MINOR) ")
  string(REGEX REPLACE ".*MAJOR +([0-9]+).*MINOR +([0-9]+).*" "\\1.\\2" Pcre2_VERSION "${_pcre2_version}")
endif()
find_package_handle_standard_args(
  Pcre2
  REQUIRED_VARS Pcre2_LIBRARY Pcre2_INCLUDE_DIR
  VERSION_VAR Pcre2_VERSION)

if(Pcre2_FOUND AND NOT TARGET Pcre2::Pcre2)
  add_library(Pcre2::Pcre2 UNKNOWN IMPORTED)
  set_target_properties(
    Pcre2::Pcre2 PROPERTIES IMPORTED_LOCATION ${Pcre2_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${Pcre2_INCLUDE_DIR}
                            INTERFACE_COMPILE_DEFINITIONS PCRE2_CODE_UNIT_WIDTH=8)
endif()
