# xxHash as the interface target XxHash::headers, XxHash_VERSION its version.
#
# Debian's package has a file for pkg-config, which links the library; we compile the hash into the one source that
# uses it, so what is built has nothing to link and nothing to load.
include(FindPackageHandleStandardArgs)

find_path(XxHash_INCLUDE_DIR xxhash.h)
mark_as_advanced(XxHash_INCLUDE_DIR)
set(XxHash_VERSION "")
if(XxHash_INCLUDE_DIR)
  file(STRINGS ${XxHash_INCLUDE_DIR}/xxhash.h _xxhash_numbers REGEX "^#define XXH_VERSION_(MAJOR|MINOR|RELEASE) ")
  list(TRANSFORM _xxhash_numbers REPLACE "^#define XXH_VERSION_[A-Z]+ +([0-9]+).*" "\\1")
  list(JOIN _xxhash_numbers "." XxHash_VERSION)
endif()
find_package_handle_standard_args(XxHash REQUIRED_VARS XxHash_INCLUDE_DIR VERSION_VAR XxHash_VERSION)

if(XxHash_FOUND AND NOT TARGET XxHash::headers)
  add_library(XxHash::headers INTERFACE IMPORTED)
  target_include_directories(XxHash::headers SYSTEM INTERFACE ${XxHash_INCLUDE_DIR})
endif()
