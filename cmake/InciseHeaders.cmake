# SPDX-License-Identifier: Apache-2.0
# Headers of other libraries take half of the time of a module's typical compilation: they are compiled once for all modules.
# Only with g++: clang-tidy and clang would take its files for their own. Builds without check that each source includes what
# it uses: the lint's, clang's and WebAssembly's.
set(incise_precompiles OFF)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND PROJECT_IS_TOP_LEVEL)
  set(incise_precompiles ON)
endif()
option(INCISE_PRECOMPILE_HEADERS "Compile headers of other libraries once (g++ only)" ${incise_precompiles})
if(NOT INCISE_PRECOMPILE_HEADERS)
  return()
endif()

set(incise_headers <Eigen/Core> <Eigen/Geometry> <algorithm> <array> <cmath> <cstdint> <cstring> <functional> <limits> <map> <memory>
                   <numeric> <optional> <span> <string> <string_view> <tuple> <utility> <vector>)
# Definitions, warnings and code options must be those of the modules, or g++ does not take them.
set(source ${PROJECT_BINARY_DIR}/generated/headers.cpp)
if(NOT EXISTS ${source})
  file(WRITE ${source} "// Has the headers compiled.\n")
endif()
add_library(incise_headers OBJECT ${source})
set_target_properties(incise_headers PROPERTIES POSITION_INDEPENDENT_CODE ON)
target_link_libraries(incise_headers PRIVATE incise_flags incise_warnings)
target_precompile_headers(incise_headers PRIVATE ${incise_headers})
# No two runs of g++ write the same bytes: ccache goes by this file instead, so that clones share what it holds.
string(SHA256 sum "${CMAKE_CXX_COMPILER_VERSION};${Eigen3_VERSION};${incise_headers}")
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/incise_headers.dir/cmake_pch.hxx.gch.sum CONTENT "${sum}\n")
