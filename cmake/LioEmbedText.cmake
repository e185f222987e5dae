# SPDX-FileCopyrightText: 2026 The liod authors
# SPDX-License-Identifier: MIT
# lio_embed_text(TARGET HEADER (NAME FILE)...): makes a private header for TARGET that defines the
# content of each file as `inline constexpr std::string_view lio::NAME`. The files may not hold the
# text )lio_text".
set(LIO_EMBED_TEXT_SCRIPT ${CMAKE_CURRENT_LIST_FILE})

if(CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
  # The suffix sv knows the length; counting a large text at compile time is above g++'s limit.
  set(text "#pragma once\n#include <string_view>\nnamespace lio {\n")
  string(APPEND text "using std::string_view_literals::operator\"\"sv;\n")
  # clang tells of texts that are longer than every compiler must take; ours take them.
  string(APPEND text "#pragma GCC diagnostic push\n"
    "#pragma GCC diagnostic ignored \"-Woverlength-strings\"\n")
  while(ENTRIES)
    list(POP_FRONT ENTRIES name file)
    file(READ ${file} content)
    string(APPEND text
      "inline constexpr std::string_view ${name} = R\"lio_text(${content})lio_text\"sv;\n")
  endwhile()
  file(WRITE ${OUTPUT} "${text}#pragma GCC diagnostic pop\n}\n")
  return()
endif()

function(lio_embed_text target header)
  set(entries ${ARGN})
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded/${header})
  set(arguments "")
  set(files "")
  while(entries)
    list(POP_FRONT entries name file)
    get_filename_component(path ${file} ABSOLUTE)
    list(APPEND arguments ${name} ${path})
    list(APPEND files ${path})
  endwhile()
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} "-DOUTPUT=${output}" "-DENTRIES=${arguments}"
      -P ${LIO_EMBED_TEXT_SCRIPT}
    DEPENDS ${files} ${LIO_EMBED_TEXT_SCRIPT} COMMENT "Embedding ${header}" VERBATIM)
  target_sources(${target} PRIVATE ${output})
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/embedded)
endfunction()
