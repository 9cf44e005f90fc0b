# SPDX-License-Identifier: Apache-2.0
# What the WebAssembly build takes of the system's packages: headers alone. /usr/include as a whole would hide
# emscripten's own C library, so a folder of links has them.
set(incise_header_links ${PROJECT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${incise_header_links})

# incise_web_headers(TARGET FOLDER MARK PACKAGE): an interface target for /usr/include/FOLDER, of which MARK is a file
function(incise_web_headers target folder mark package)
  find_path(INCISE_HEADERS_OF_${folder} ${folder}/${mark} PATHS /usr/include NO_CMAKE_FIND_ROOT_PATH)
  mark_as_advanced(INCISE_HEADERS_OF_${folder})
  if(NOT INCISE_HEADERS_OF_${folder})
    message(FATAL_ERROR "the WebAssembly build needs ${folder}/${mark}: install ${package}")
  endif()
  file(CREATE_LINK ${INCISE_HEADERS_OF_${folder}}/${folder} ${incise_header_links}/${folder} SYMBOLIC)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} SYSTEM INTERFACE ${incise_header_links})
endfunction()

if(INCISE_BUILD_WEB)
  incise_web_headers(incise_fmt fmt format.h libfmt-dev)
  incise_web_headers(nlohmann_json::nlohmann_json nlohmann json.hpp nlohmann-json3-dev)
  # No threads are started; std::thread needs nothing to link.
  add_library(Threads::Threads INTERFACE IMPORTED GLOBAL)
endif()
if(INCISE_WITH_HIGHWAY)
  incise_web_headers(hwy::hwy hwy highway.h libhwy-dev)
  # One target of instructions, so that nothing of libhwy is linked.
  target_compile_definitions(hwy::hwy INTERFACE HWY_COMPILE_ONLY_STATIC)
endif()
