include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# What every number of ours is computed with; the target is never exported to users.
# -ffp-contract=off: no fused operations, so that the same input gives the same bytes everywhere.
# -fno-trapping-math: nobody asks for floating-point exceptions; without it GCC does no loop with a comparison in
# vectors. The values are the same.
add_library(hypermap_determinism INTERFACE)
target_compile_options(hypermap_determinism INTERFACE -ffp-contract=off -fno-trapping-math)

# Our own code is compiled with strict warnings; the target is never exported to users.
# GCC 12 warns falsely of overlapping strings and of uninitialised optionals (its bugs 105329 and 80635), and in unity
# builds takes sources, which may have types of their own, for headers. With a precompiled header it no longer knows which
# code is the system's, and warns there of strings that overflow, falsely (its bug 105651).
add_library(hypermap_warnings INTERFACE)
target_compile_options(hypermap_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wnon-virtual-dtor
  -Woverloaded-virtual -Wold-style-cast -Wdouble-promotion
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict -Wno-maybe-uninitialized>
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:${CMAKE_UNITY_BUILD}>>:-Wno-subobject-linkage>
  "$<$<AND:$<CXX_COMPILER_ID:GNU>,$<NOT:$<BOOL:${CMAKE_DISABLE_PRECOMPILE_HEADERS}>>>:-Wno-stringop-overflow;-Wno-array-bounds>"
  $<$<BOOL:${HYPERMAP_WERROR}>:-Werror>)

# In unity builds the sources of one folder are one unit: names of anonymous namespaces are unique in a folder only.
function(hypermap_unite_by_folder target)
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    get_filename_component(folder ${source} DIRECTORY)
    string(MAKE_C_IDENTIFIER "${target}_${folder}" group)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
endfunction()

# hypermap_add_library_headers(<target>)
#
# What most sources of the libraries include, parsed once, for the libraries that are added after it in this folder and
# below: a precompiled header serves targets with the same options only, so those that steer have one of their own where
# they are not optimised. Presets `dev` and `tidy` compile without it, so that no source leans on what it does not include.
function(hypermap_add_library_headers target)
  hypermap_find_packages(Eigen3 tl-expected)
  set(headers ${target} ${target}_steering)
  foreach(name ${headers})
    set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
    file(WRITE ${source} "")
    add_library(${name} STATIC EXCLUDE_FROM_ALL ${source})
    target_link_libraries(${name} PRIVATE Eigen3::Eigen tl::expected hypermap_warnings hypermap_determinism)
    target_compile_features(${name} PRIVATE cxx_std_20)
    set_target_properties(${name} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
    target_precompile_headers(${name} PRIVATE <Eigen/Core> <Eigen/Geometry> <tl/expected.hpp> <algorithm> <array>
      <charconv> <filesystem> <functional> <map> <memory> <optional> <set> <span> <string> <string_view> <unordered_map>
      <vector>)
  endforeach()
  target_compile_options(${target}_steering PRIVATE -O0)
  set(HYPERMAP_LIBRARY_HEADERS ${target} PARENT_SCOPE)
endfunction()

# hypermap_find_packages(<package>...): each "name" or "name arguments of find_package".
macro(hypermap_find_packages)
  foreach(package ${ARGN})
    separate_arguments(package)
    find_package(${package} REQUIRED)
  endforeach()
endmacro()

# hypermap_add_module(<name> [STEERS] SOURCES ... [ROOMS ...] [PACKAGES ...] PUBLIC_LINK ... [PRIVATE_LINK ...])
#
# One call a library: a top-level folder, or a room of io. Makes the library hypermap_<name>, its alias
# hypermap::<name>, its header set (everything under include/), its install rules and the component <name> of the
# installed package.
# PACKAGES: third-party packages that it links, as hypermap_find_packages takes them; users of the component get them too.
# The arrows of ARCHITECTURE.md are written here and nowhere else, and tests/tools/check_layers.py holds every #include
# against them. PUBLIC_LINK: what its headers may include of ours; PRIVATE_LINK: what only its sources may.
# STEERS: calls what computes, which is elsewhere. Debug builds (sanitizers) do not optimise it: that would take longer than
# it saves.
# ROOMS: the sub-folders of a library, each "room" or "room -> rooms that it may include".
function(hypermap_add_module name)
  cmake_parse_arguments(ARG "STEERS" "" "SOURCES;ROOMS;PACKAGES;PUBLIC_LINK;PRIVATE_LINK" ${ARGN})
  hypermap_find_packages(${ARG_PACKAGES})
  set(target hypermap_${name})
  add_library(${target} STATIC ${ARG_SOURCES})
  add_library(hypermap::${name} ALIAS ${target})
  hypermap_unite_by_folder(${target})
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/include/*.hpp)
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS include FILES ${headers})
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC_LINK}
                                  PRIVATE ${ARG_PRIVATE_LINK} $<BUILD_INTERFACE:hypermap_warnings>
                                          $<BUILD_INTERFACE:hypermap_determinism>)
  target_include_directories(${target} PRIVATE src)
  if(ARG_STEERS AND CMAKE_BUILD_TYPE STREQUAL "Debug")
    target_compile_options(${target} PRIVATE -O0)
    target_precompile_headers(${target} REUSE_FROM ${HYPERMAP_LIBRARY_HEADERS}_steering)
  else()
    target_precompile_headers(${target} REUSE_FROM ${HYPERMAP_LIBRARY_HEADERS})
  endif()
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} CXX_EXTENSIONS OFF LINKER_LANGUAGE CXX
                                             POSITION_INDEPENDENT_CODE ON
                                             VERIFY_INTERFACE_HEADER_SETS ON)
  install(TARGETS ${target} EXPORT hypermap-${name}-targets FILE_SET HEADERS)
  hypermap_add_component(${name} "${ARG_PUBLIC_LINK};${ARG_PRIVATE_LINK}" "${ARG_PACKAGES}")
endfunction()

# hypermap_add_component(<name> <links> <packages>): notes what the package file has to say of a library. A static
# library's private links are its users' too. Libraries are added after those that they link, so a list of components in
# the order of their adding has what each needs before it.
function(hypermap_add_component name links packages)
  list(FILTER links INCLUDE REGEX "^hypermap::")
  list(TRANSFORM links REPLACE "^hypermap::" "")
  foreach(link IN LISTS links)
    if(NOT TARGET hypermap_${link})
      message(FATAL_ERROR "${name} links ${link}, which is added after it")
    endif()
  endforeach()
  install(EXPORT hypermap-${name}-targets NAMESPACE hypermap::
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hypermap)
  set_property(GLOBAL APPEND PROPERTY HYPERMAP_COMPONENTS ${name})
  set_property(GLOBAL APPEND_STRING PROPERTY HYPERMAP_COMPONENT_TABLE
               "set(_hypermap_links_${name} \"${links}\")\nset(_hypermap_packages_${name} \"${packages}\")\n")
endfunction()

# hypermap_use_threads(<variable> <source>...): whether tests in these files start threads or ask the libraries to.
# Who asks for one thread alone does not.
function(hypermap_use_threads variable)
  set(${variable} FALSE PARENT_SCOPE)
  foreach(source ${ARGN})
    file(STRINGS ${source} found REGEX "thread|std::async|segment_all")
    list(FILTER found EXCLUDE REGEX "^[^/]*num_threads = 1[^0-9]*$")
    if(found)
      set(${variable} TRUE PARENT_SCOPE)
    endif()
  endforeach()
endfunction()

# Programs whose tests use threads; the thread sanitizer has nothing to find in the others.
add_custom_target(thread_tests)

# What nearly every test includes, parsed once for each optimisation level: a third of the time that tests take to
# compile. A precompiled header serves programs with the same options only.
function(hypermap_add_test_headers)
  foreach(name hypermap_tests_pch hypermap_computing_tests_pch)
    file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp "")
    add_library(${name} STATIC ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
    target_link_libraries(${name} PRIVATE Eigen3::Eigen tl::expected GTest::gmock hypermap_warnings hypermap_determinism)
    target_compile_features(${name} PRIVATE cxx_std_20)
    target_precompile_headers(${name} PRIVATE <Eigen/Core> <Eigen/Geometry> <gmock/gmock.h> <gtest/gtest.h>
      <tl/expected.hpp> <algorithm> <array> <filesystem> <functional> <map> <memory> <optional> <random> <set> <span>
      <string> <string_view> <vector>)
  endforeach()
  target_compile_options(hypermap_tests_pch PRIVATE -O0)
endfunction()

# hypermap_add_tests(<name> [COMPUTES] [IN_ONE_PROCESS] [COST <seconds>] SOURCES ... LINK ...)
#
# One GoogleTest program. It knows where the project's data lie (support/test_data.hpp) and where data by others may lie
# (environment HYPERMAP_DATA, else ../shared/data beside the project); tests of the latter skip with a message when it
# is absent. Programs with threads bear the label `threads` and are built by the target `thread_tests`.
# COMPUTES: the tests themselves work hard (scenes, brute force) and are worth optimising. Most tests need to compile
# fast, not to run fast; the libraries are optimised in every build but `dev`.
# COST: about how many seconds it takes as a whole under a sanitizer, where it is among the longest; those are begun first.
# IN_ONE_PROCESS: all its tests are one of CTest's, not a process each: for what takes longer to start than to run.
function(hypermap_add_tests name)
  cmake_parse_arguments(ARG "COMPUTES;IN_ONE_PROCESS" "COST" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINK} hypermap_test_data hypermap_warnings hypermap_determinism
                                        GTest::gmock GTest::gtest_main)
  if(ARG_COMPUTES)
    target_precompile_headers(${name} REUSE_FROM hypermap_computing_tests_pch)
  else()
    target_compile_options(${name} PRIVATE -O0)
    target_precompile_headers(${name} REUSE_FROM hypermap_tests_pch)
  endif()
  hypermap_use_threads(with_threads ${ARG_SOURCES})
  set(label "")
  if(with_threads)
    add_dependencies(thread_tests ${name})
    set(label LABELS threads)
  endif()
  if(HYPERMAP_WHOLE_TEST_PROGRAMS OR ARG_IN_ONE_PROCESS)
    add_test(NAME ${name} COMMAND ${name} --gtest_brief=1)
    set_tests_properties(${name} PROPERTIES TIMEOUT 1800 ${label})
    if(ARG_COST)
      set_tests_properties(${name} PROPERTIES COST ${ARG_COST})
    endif()
  else()
    gtest_discover_tests(${name} TEST_PREFIX ${name}/ DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600 ${label})
  endif()
endfunction()

# Target `tidy`: clang-tidy over everything that this build would compile, as `.clang-tidy` says. With unity builds
# (preset `tidy`) a folder is one unit: the linter walks through its many headers once, which makes it ten times faster.
function(hypermap_add_tidy_target)
  add_custom_target(tidy COMMAND ${PROJECT_SOURCE_DIR}/scripts/lint --all
                    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} COMMENT "clang-tidy" VERBATIM USES_TERMINAL)
endfunction()

function(hypermap_install_package)
  get_property(HYPERMAP_COMPONENTS GLOBAL PROPERTY HYPERMAP_COMPONENTS)
  get_property(HYPERMAP_COMPONENT_TABLE GLOBAL PROPERTY HYPERMAP_COMPONENT_TABLE)
  configure_package_config_file(cmake/hypermap-config.cmake.in hypermap-config.cmake
          INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hypermap)
  write_basic_package_version_file(hypermap-config-version.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/hypermap-config.cmake
                ${PROJECT_BINARY_DIR}/hypermap-config-version.cmake
                cmake/FindLibDeflate.cmake
                cmake/FindPcre2.cmake
                cmake/FindPclLite.cmake
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/hypermap)
endfunction()
