# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# Warnings, language level and sanitizers, linked privately by every target of ours.
find_program(LIO_CCACHE ccache)
if(LIO_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${LIO_CCACHE})
endif()

add_library(lio_warnings INTERFACE)
target_compile_features(lio_warnings INTERFACE cxx_std_20)
target_compile_options(lio_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
  -Wno-sign-conversion -Wnon-virtual-dtor -Wold-style-cast -Wcast-qual
  $<$<BOOL:${LIO_WERROR}>:-Werror>)

# Programs load only the libraries that they use; PCL's alone cost 20 ms and 25 MB.
add_link_options(LINKER:--as-needed)

# Sanitizers concern every object that is linked together, so they are set for the whole build.
if(LIO_SANITIZE)
  add_compile_options(-fsanitize=${LIO_SANITIZE} -fno-omit-frame-pointer)
  if(LIO_SANITIZE MATCHES "undefined")
    add_compile_options(-fno-sanitize-recover=all)
  endif()
  # The address sanitizer reports the same accesses as these two checks, which a quarter of the
  # time to compile goes into.
  if(LIO_SANITIZE MATCHES "address.*undefined")
    add_compile_options(-fno-sanitize=object-size,null)
  endif()
  add_link_options(-fsanitize=${LIO_SANITIZE})
endif()

# lio_unite(TARGET): compiles the sources of one folder together, a dozen at a time, which takes half
# the time: Eigen's and GoogleTest's templates cost more than our own lines. Only with LIO_UNITY: a
# build after a small change does better without. Names in the anonymous namespaces of a folder
# must therefore differ.
function(lio_unite target)
  if(NOT LIO_UNITY)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(GET folder FILENAME group)
    list(APPEND sources_of_${group} ${source})
    list(LENGTH sources_of_${group} number)
    math(EXPR batch "${number} / 12")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP "${group}_${batch}")
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# lio_inline_eigen(TARGET): a sanitizer's checks make functions too large for clang to inline, and
# Eigen calls dozens of them for one sum; with this the core tests take .57 of the time. Only for
# optimized sources: at -O0 the compiler takes gigabytes.
function(lio_inline_eigen target)
  if(LIO_SANITIZE)
    target_compile_definitions(${target} PRIVATE
      "EIGEN_STRONG_INLINE=__attribute__((always_inline)) inline")
  endif()
endfunction()

# lio_library(NAME MODULE...): a static library of every source in src/<MODULE>/, one folder a module.
function(lio_library name)
  set(sources "")
  foreach(module IN LISTS ARGN)
    file(GLOB module_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/${module}/*.cpp)
    list(APPEND sources ${module_sources})
  endforeach()
  add_library(${name} STATIC ${sources})
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}/include>
    PRIVATE ${CMAKE_SOURCE_DIR}/src) # "MODULE/..." private headers
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_link_libraries(${name} PRIVATE $<BUILD_INTERFACE:lio_warnings>)
  # The Python module is a shared object, and an embedder's may be one. Without interposition the
  # compiler inlines as in a program.
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${name} PRIVATE -fno-semantic-interposition)
  lio_inline_eigen(${name})
  # Fuzzers see which branches an input takes in what reads bytes; the estimator would only be slowed.
  if(LIO_FUZZ AND name MATCHES "^lio_(io|convert|eval|report)$")
    target_compile_options(${name} PRIVATE -fsanitize=fuzzer-no-link)
    target_link_options(${name} INTERFACE -fsanitize=fuzzer-no-link)
  endif()
  # lio-replay links only the objects of lio_run that it needs, and so no reader of bags with its
  # libraries (install_test.py).
  if(NOT name STREQUAL "lio_run")
    lio_unite(${name})
  endif()
endfunction()

# Everything a user runs; tools/setup.sh builds this and leaves the tests alone.
add_custom_target(lio_programs)

# lio_program(NAME SOURCE... LIBS LIBRARY... [INTERNAL]): one thin program, installed with the others
# unless it is INTERNAL, a helper of tests and benchmarks. Its own sources only read arguments and
# call libraries: at -O1 they compile in two thirds of the time.
function(lio_program name)
  cmake_parse_arguments(arg "INTERNAL" "" "LIBS" ${ARGN})
  add_executable(${name} ${arg_UNPARSED_ARGUMENTS})
  target_compile_definitions(${name} PRIVATE LIO_VERSION="${PROJECT_VERSION}")
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  target_link_libraries(${name} PRIVATE lio_warnings ${arg_LIBS})
  add_dependencies(lio_programs ${name})
  if(NOT arg_INTERNAL)
    install(TARGETS ${name} RUNTIME)
  endif()
endfunction()

# lio_test_options(NAME LIBRARY...): a test program's own sources are compiled with little
# optimization, and with none in a sanitized build: most of them take longer to compile than to run,
# and -O1 takes three quarters of the time of -O3. A sanitized build links the estimator ahead of the
# test's objects: the linker keeps the first copy of an Eigen function that both hold, and the
# estimator's is optimized.
function(lio_test_options name)
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  if(LIO_SANITIZE)
    target_compile_options(${name} PRIVATE -O0)
    if(lio_core IN_LIST ARGN)
      target_link_options(${name} PRIVATE
        "LINKER:--whole-archive,$<TARGET_FILE:lio_core>,--no-whole-archive")
    endif()
  endif()
endfunction()

# lio_test(NAME MODULE... LIBS LIBRARY... PROPERTIES PROPERTY VALUE...): one test program of every
# test/<MODULE>/*_test.cpp; the properties are those of its tests.
function(lio_test name)
  cmake_parse_arguments(arg "" "" "LIBS;PROPERTIES" ${ARGN})
  set(sources "")
  foreach(module IN LISTS arg_UNPARSED_ARGUMENTS)
    file(GLOB module_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/test/${module}/*_test.cpp)
    list(APPEND sources ${module_sources})
  endforeach()
  if(NOT sources)
    return()
  endif()
  add_executable(${name} ${sources})
  target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR}/test ${CMAKE_SOURCE_DIR}/src)
  target_link_libraries(${name} PRIVATE lio_warnings ${arg_LIBS} lio_build_paths
    GTest::gtest GTest::gmock GTest::gtest_main)
  lio_unite(${name})
  lio_test_options(${name} ${arg_LIBS})
  set(mode POST_BUILD)
  if(LIO_SANITIZE)
    set(mode PRE_TEST)
  endif()
  # The build does not start sanitized programs to list their tests: no suppressions are set there.
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60
    DISCOVERY_MODE ${mode} PROPERTIES TIMEOUT 300 ${arg_PROPERTIES})
endfunction()
