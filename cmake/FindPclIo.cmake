# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Only PCL's files are used. Its own CMake package looks for VTK, Qt, OpenNI and more on the way and
# takes seconds; header and two libraries are all there is to find.
find_path(PCL_INCLUDE_DIR pcl/io/pcd_io.h PATH_SUFFIXES pcl-1.15 pcl-1.14 pcl-1.13 pcl-1.12 REQUIRED)
find_library(PCL_IO_LIBRARY pcl_io REQUIRED)
find_library(PCL_COMMON_LIBRARY pcl_common REQUIRED)
add_library(lio_pcl_io INTERFACE)
target_include_directories(lio_pcl_io SYSTEM INTERFACE ${PCL_INCLUDE_DIR})
target_link_libraries(lio_pcl_io INTERFACE ${PCL_IO_LIBRARY} ${PCL_COMMON_LIBRARY} Eigen3::Eigen)
