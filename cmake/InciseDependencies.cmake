# SPDX-License-Identifier: Apache-2.0
# Finds what the library and the programs stand on, once and for every folder.
set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
if(INCISE_WITH_TBB)
  find_package(TBB REQUIRED)
endif()
if(INCISE_WITH_VTU)
  find_package(pugixml REQUIRED)
endif()
if(INCISE_WITH_GZIP OR INCISE_BUILD_VIEW)
  find_package(ZLIB REQUIRED)
endif()
if(EMSCRIPTEN)
  include(InciseWebDependencies)
elseif(INCISE_WITH_HIGHWAY)
  find_package(hwy REQUIRED)
endif()
if(NOT EMSCRIPTEN)
  find_package(Threads REQUIRED)
  find_package(fmt REQUIRED)
  find_package(nlohmann_json REQUIRED)
endif()
if(INCISE_BUILD_APPS)
  find_package(CLI11 REQUIRED)
  find_package(spdlog REQUIRED)
endif()
# Of haptic devices; programs do without where it is not there, and say so.
set(INCISE_BEAST_INCLUDE)
if(INCISE_WITH_HAPLY)
  find_path(INCISE_BEAST_HEADERS boost/beast/websocket.hpp)
  mark_as_advanced(INCISE_BEAST_HEADERS)
  if(INCISE_BEAST_HEADERS)
    set(INCISE_BEAST_INCLUDE ${INCISE_BEAST_HEADERS})
  else()
    message(STATUS "Without haptic devices (--device haply): Boost.Beast is not there; install libboost-dev")
  endif()
endif()
if(INCISE_BUILD_VIEW)
  # libepoxy's pkg-config file would need pkg-config. Its EGL header wants those of libegl-dev.
  find_path(INCISE_EPOXY_INCLUDE epoxy/egl.h)
  find_library(INCISE_EPOXY_LIBRARY epoxy)
  find_path(INCISE_EGL_INCLUDE EGL/eglplatform.h)
  find_path(INCISE_STB_INCLUDE stb/stb_image_write.h)
  mark_as_advanced(INCISE_EPOXY_INCLUDE INCISE_EPOXY_LIBRARY INCISE_EGL_INCLUDE INCISE_STB_INCLUDE)
  if(NOT (INCISE_EPOXY_INCLUDE AND INCISE_EPOXY_LIBRARY AND INCISE_EGL_INCLUDE AND INCISE_STB_INCLUDE))
    message(FATAL_ERROR "INCISE_BUILD_VIEW needs libepoxy-dev libegl-dev libstb-dev: install them, or configure with "
                        "-DINCISE_BUILD_VIEW=OFF")
  endif()
  add_library(incise_epoxy INTERFACE)
  target_link_libraries(incise_epoxy INTERFACE ${INCISE_EPOXY_LIBRARY})
  target_include_directories(incise_epoxy SYSTEM INTERFACE ${INCISE_EPOXY_INCLUDE} ${INCISE_EGL_INCLUDE}
                                                           ${INCISE_STB_INCLUDE})
  # The window. Dear ImGui has no package file that CMake reads.
  find_package(glfw3 3.3 REQUIRED)
  find_path(INCISE_IMGUI_INCLUDE imgui.h PATH_SUFFIXES imgui REQUIRED)
  find_library(INCISE_IMGUI_LIBRARY imgui REQUIRED)
  find_library(INCISE_STB_LIBRARY stb REQUIRED)  # Debian's Dear ImGui takes its fonts from it
  mark_as_advanced(INCISE_IMGUI_INCLUDE INCISE_IMGUI_LIBRARY INCISE_STB_LIBRARY)
  add_library(incise_imgui INTERFACE)
  target_link_libraries(incise_imgui INTERFACE ${INCISE_IMGUI_LIBRARY} ${INCISE_STB_LIBRARY} glfw ${CMAKE_DL_LIBS})
  target_include_directories(incise_imgui SYSTEM INTERFACE ${INCISE_IMGUI_INCLUDE})
endif()

# Package that provides each imported target that a module may link privately, for the installed config file.
set(incise_package_of_TBB::tbb TBB)
set(incise_package_of_pugixml::pugixml pugixml)
set(incise_package_of_pugixml pugixml)
set(incise_package_of_ZLIB::ZLIB ZLIB)
set(incise_package_of_fmt::fmt fmt)
set(incise_package_of_spdlog::spdlog spdlog)
set(incise_package_of_hwy::hwy hwy)
set(incise_package_of_Threads::Threads Threads)
# Nothing of these is left to link once the library is built.
set(incise_header_only Eigen3::Eigen nlohmann_json::nlohmann_json fmt::fmt-header-only CLI11::CLI11
                       spdlog::spdlog_header_only)

# A compiler cache, where there is one. Emscripten brings its own wrapper. It takes precompiled headers only where it is told
# to trust the definitions that they were compiled with, and the sums beside them, both of which InciseHeaders.cmake sees to.
if(PROJECT_IS_TOP_LEVEL AND NOT EMSCRIPTEN AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(INCISE_CCACHE ccache)
  mark_as_advanced(INCISE_CCACHE)
  if(INCISE_CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER
        ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_PCH_EXTSUM=1 ${INCISE_CCACHE})
  endif()
endif()
