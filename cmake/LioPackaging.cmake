# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# What makes liod a service of a Debian machine: the systemd unit, the sysctl file that a user may
# copy, manual pages (where help2man is), and the Debian package that cpack makes.
configure_file(${CMAKE_SOURCE_DIR}/packaging/liod.service.in ${CMAKE_BINARY_DIR}/liod.service @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/liod.service DESTINATION lib/systemd/system)
install(FILES packaging/60-liod.conf DESTINATION ${CMAKE_INSTALL_DATADIR}/liod/sysctl)
