# The parts of PCL that we use, as the interface target PclLite::pcl.
#
# PCL's own package file brings VTK, Qt and MPI into the link line; these libraries need none of them. Its filters,
# features and segmentation are templates that we instantiate for the one type of point that we use: their libraries
# hold all types and take 60 ms to load.
include(FindPackageHandleStandardArgs)
find_package(Eigen3 REQUIRED)
find_package(Boost REQUIRED)

find_path(PclLite_INCLUDE_DIR pcl/point_types.h PATH_SUFFIXES pcl-1.15 pcl-1.14 pcl-1.13 pcl-1.12)
set(_pcl_libraries "")
set(_pcl_required PclLite_INCLUDE_DIR)
foreach(part common kdtree search)
  find_library(PclLite_${part}_LIBRARY pcl_${part})
  list(APPEND _pcl_libraries ${PclLite_${part}_LIBRARY})
  list(APPEND _pcl_required PclLite_${part}_LIBRARY)
endforeach()
find_package_handle_standard_args(PclLite REQUIRED_VARS ${_pcl_required})

if(PclLite_FOUND AND NOT TARGET PclLite::pcl)
  add_library(PclLite::pcl INTERFACE IMPORTED)
  target_include_directories(PclLite::pcl SYSTEM INTERFACE ${PclLite_INCLUDE_DIR})
  target_link_libraries(PclLite::pcl INTERFACE ${_pcl_libraries} Eigen3::Eigen Boost::headers)
endif()
