# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Other programs see this of liod after `cmake --install`: the package `liod` with the target
# liod::core. A header is public when it stands in this list, and it may include only headers that
# stand here, too (test/integration/install_test.py checks both).
set(LIO_PUBLIC_HEADERS
  lio/base/counters.hpp
  lio/base/ledger.hpp
  lio/base/notice.hpp
  lio/base/pose.hpp
  lio/base/rotation.hpp
  lio/base/time.hpp
  lio/filter/clock_estimate.hpp
  lio/filter/filter_options.hpp
  lio/map/ndt_options.hpp
  lio/pcl_conversions.hpp
  lio/pipeline/odometry.hpp
  lio/pipeline/options.hpp
  lio/pipeline/outputs.hpp
  lio/pipeline/synchronous_odometry.hpp
  lio/registration/gicp_options.hpp
  lio/registration/loam_options.hpp
  lio/registration/match_status.hpp
  lio/scan/loam_feature_options.hpp
  lio/scan/reduce_options.hpp
  lio/sensor/imu_noise.hpp
  lio/sensor/imu_sample.hpp
  lio/sensor/lidar_sweep.hpp
  lio/sensor/rig.hpp
  lio/sensor/scan_chunk.hpp
  lio/verdict/verdict.hpp)

include(CMakePackageConfigHelpers)

# lio_install_package(): the library, its headers and the files that find_package(liod) reads.
function(lio_install_package)
  set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/liod)
  list(TRANSFORM LIO_PUBLIC_HEADERS PREPEND ${CMAKE_SOURCE_DIR}/include/ OUTPUT_VARIABLE headers)
  target_sources(lio_core PUBLIC FILE_SET HEADERS BASE_DIRS ${CMAKE_SOURCE_DIR}/include
    FILES ${headers})
  set_target_properties(lio_core PROPERTIES EXPORT_NAME core)
  add_library(liod::core ALIAS lio_core)
  install(TARGETS lio_core EXPORT liodTargets ARCHIVE COMPONENT liod-dev FILE_SET HEADERS
    COMPONENT liod-dev)
  install(EXPORT liodTargets NAMESPACE liod:: DESTINATION ${package_dir}
    COMPONENT liod-dev)

  configure_package_config_file(${CMAKE_SOURCE_DIR}/cmake/liodConfig.cmake.in
    ${CMAKE_BINARY_DIR}/liodConfig.cmake INSTALL_DESTINATION ${package_dir}
    PATH_VARS CMAKE_INSTALL_DATADIR)
  write_basic_package_version_file(${CMAKE_BINARY_DIR}/liodConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
  install(FILES ${CMAKE_BINARY_DIR}/liodConfig.cmake ${CMAKE_BINARY_DIR}/liodConfigVersion.cmake
    DESTINATION ${package_dir} COMPONENT liod-dev)
endfunction()
