# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Debian's liblcm-dev has no CMake files and its pkg-config file asks for glib's, which it does not
# bring: look for header, library and generator by hand. Gives the target lcm::lcm and
# lio_lcm_types(TARGET DIR), an interface library of the C++ headers that lcm-gen makes.
find_package(lcm CONFIG QUIET)
if(NOT TARGET lcm::lcm)
  find_path(LCM_INCLUDE_DIR lcm/lcm-cpp.hpp REQUIRED)
  find_library(LCM_LIBRARY lcm REQUIRED)
  add_library(lcm::lcm UNKNOWN IMPORTED)
  set_target_properties(lcm::lcm PROPERTIES IMPORTED_LOCATION ${LCM_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${LCM_INCLUDE_DIR})
endif()
find_program(LCM_GEN lcm-gen REQUIRED)

function(lio_lcm_types target dir)
  file(GLOB definitions CONFIGURE_DEPENDS ${dir}/*.lcm)
  set(out ${CMAKE_BINARY_DIR}/lcmtypes/cpp)
  set(headers "")
  foreach(definition IN LISTS definitions)
    get_filename_component(stem ${definition} NAME_WE) # lio_imu_t -> lio/imu_t.hpp
    string(REGEX REPLACE "^lio_" "" type ${stem})
    list(APPEND headers ${out}/lio/${type}.hpp)
  endforeach()
  add_custom_command(OUTPUT ${headers}
    COMMAND ${LCM_GEN} --cpp --cpp-std=c++11 --cpp-hpath ${out} ${definitions}
    DEPENDS ${definitions} COMMENT "lcm-gen: C++ types" VERBATIM)
  add_custom_target(${target}_headers DEPENDS ${headers})
  add_library(${target} INTERFACE)
  add_dependencies(${target} ${target}_headers)
  target_include_directories(${target} SYSTEM INTERFACE ${out})
  target_link_libraries(${target} INTERFACE lcm::lcm)
endfunction()
