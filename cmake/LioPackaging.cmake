# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# These files make liod a service of a Debian machine: the systemd unit, the sysctl file a user may
# copy, manual pages (where help2man is), and the Debian package that cpack makes.
configure_file(${CMAKE_SOURCE_DIR}/packaging/liod.service.in ${CMAKE_BINARY_DIR}/liod.service @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/liod.service DESTINATION lib/systemd/system)
install(FILES packaging/60-liod.conf DESTINATION ${CMAKE_INSTALL_DATADIR}/liod/sysctl)
install(FILES packaging/realtime.conf DESTINATION ${CMAKE_INSTALL_DATADIR}/liod/systemd)

# A manual page of each program, from its --help.
find_program(LIO_HELP2MAN help2man)
set(man_pages "")
if(LIO_HELP2MAN AND NOT LIO_SANITIZE)
  foreach(program liod lio-replay lio-run lio-sim lio-eval lio-log lio-convert lio-view)
    set(page ${CMAKE_BINARY_DIR}/man/${program}.1)
    add_custom_command(OUTPUT ${page}
      COMMAND ${LIO_HELP2MAN} --no-info --version-string=${PROJECT_VERSION}
        --name=${PROJECT_DESCRIPTION} --output=${page} $<TARGET_FILE:${program}>
      COMMAND gzip -9nkf ${page}
      DEPENDS ${program} COMMENT "Manual page of ${program}" VERBATIM)
    list(APPEND man_pages ${page})
    install(FILES ${page}.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL)
  endforeach()
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/man)
  add_custom_target(lio_man_pages ALL DEPENDS ${man_pages})
  add_dependencies(lio_programs lio_man_pages)
endif()

# A completion of each program for bash, from its --help as well.
find_package(Python3 COMPONENTS Interpreter QUIET)
set(completions "")
if(Python3_FOUND AND NOT LIO_SANITIZE)
  foreach(program liod lio-replay lio-run lio-sim lio-eval lio-log lio-convert lio-view)
    set(completion ${CMAKE_BINARY_DIR}/completions/${program})
    add_custom_command(OUTPUT ${completion}
      COMMAND Python3::Interpreter ${CMAKE_SOURCE_DIR}/packaging/completion.py
        $<TARGET_FILE:${program}> ${completion}
      DEPENDS ${program} packaging/completion.py COMMENT "Completion of ${program}" VERBATIM)
    list(APPEND completions ${completion})
    install(FILES ${completion} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
      OPTIONAL)
  endforeach()
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/completions)
  add_custom_target(lio_completions ALL DEPENDS ${completions})
  add_dependencies(lio_programs lio_completions)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME liod)
set(CPACK_PACKAGE_CONTACT "The liod authors <liod@example.org>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(LIO_PACKAGES liod liod-dev liod-doc)
if(TARGET lio_python)
  list(APPEND LIO_PACKAGES python3-liod)
endif()
set(CPACK_COMPONENTS_ALL ${LIO_PACKAGES})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_LIOD_PACKAGE_NAME liod)
set(CPACK_DEBIAN_LIOD_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LIOD_PACKAGE_SUGGESTS "liod-doc, python3-matplotlib")
set(CPACK_DEBIAN_LIOD-DEV_PACKAGE_NAME liod-dev)
set(CPACK_DEBIAN_LIOD-DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIOD-DEV_PACKAGE_DEPENDS
  "libeigen3-dev, libceres-dev, libtbb-dev, libboost-dev, libfmt-dev")
set(CPACK_DEBIAN_LIOD-DOC_PACKAGE_NAME liod-doc)
set(CPACK_DEBIAN_LIOD-DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_LIOD-DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PYTHON3-LIOD_PACKAGE_NAME python3-liod)
set(CPACK_DEBIAN_PYTHON3-LIOD_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON3-LIOD_PACKAGE_SHLIBDEPS ON)
if(TARGET lio_python) # its module is for one version of Python; liod has the tables of lidars
  math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON3-LIOD_PACKAGE_DEPENDS "liod (= ${PROJECT_VERSION}), python3-numpy, \
python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next_minor})")
endif()
set(CPACK_DEBIAN_PYTHON3-LIOD_PACKAGE_SUGGESTS "liod-doc, python3-matplotlib")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_COMPONENT_LIOD_DESCRIPTION
  "The daemon liod, and programs that replay, simulate, convert and judge drives.")
set(CPACK_COMPONENT_LIOD-DEV_DESCRIPTION
  "Library and headers: the estimator of liod as the CMake target liod::core.")
set(CPACK_COMPONENT_LIOD-DOC_DESCRIPTION
  "Messages, configuration, design and results of liod, and examples.")
set(CPACK_COMPONENT_PYTHON3-LIOD_DESCRIPTION
  "The Python package liod: logs, estimator, conversion, evaluation with NumPy.")
include(CPack)

# Debian wants the licence and the changes in every package.
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC) # follows SOURCE_DATE_EPOCH
file(WRITE ${CMAKE_BINARY_DIR}/packaging/changelog
  "liod (${PROJECT_VERSION}) unstable; urgency=medium\n\n"
  "  * CHANGELOG.md of liod-doc has the changes.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${now}\n")
execute_process(COMMAND gzip -9nkf ${CMAKE_BINARY_DIR}/packaging/changelog)
# report.html contains uPlot, lio-view contains it and three.js; their licences ask for their text.
file(READ ${CMAKE_SOURCE_DIR}/LICENSE licence)
file(READ ${CMAKE_SOURCE_DIR}/third_party/uplot/LICENSE uplot_licence)
file(READ ${CMAKE_SOURCE_DIR}/third_party/three/LICENSE three_licence)
file(WRITE ${CMAKE_BINARY_DIR}/packaging/copyright "${licence}\n"
  "The pages report.html and lio-view contain uPlot, https://github.com/leeoniya/uPlot, by this\n"
  "licence:\n\n${uplot_licence}\n"
  "lio-view contains three.js, https://threejs.org, by this licence:\n\n${three_licence}")
foreach(package IN LISTS LIO_PACKAGES)
  install(FILES ${CMAKE_BINARY_DIR}/packaging/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
    COMPONENT ${package})
  install(FILES ${CMAKE_BINARY_DIR}/packaging/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${package})
endforeach()
