# SPDX-License-Identifier: Apache-2.0
# The libraries from outside, for whom this is built: the packages of the machine that builds, or,
# for another one, only their headers, which are the same everywhere.
if(NOT CMAKE_CROSSCOMPILING)
  find_package(Eigen3 3.4 REQUIRED NO_MODULE)
  find_package(Threads REQUIRED)
  find_package(ZLIB REQUIRED)
  find_package(CLI11 REQUIRED)
  find_package(fmt REQUIRED)
  find_package(nlohmann_json REQUIRED)
  find_package(tomlplusplus REQUIRED)
  find_package(cmocka REQUIRED)
  find_package(Ceres REQUIRED QUIET)
  find_package(OpenSSL REQUIRED COMPONENTS Crypto)
  # Not by its own package file, which would link what the library has for itself: OpenSSL, zlib,
  # and the event libraries that it can be run on.
  find_path(libwebsockets_include libwebsockets.h REQUIRED)
  find_library(libwebsockets_library websockets REQUIRED)
  add_library(graben_libwebsockets INTERFACE IMPORTED GLOBAL)
  target_include_directories(graben_libwebsockets SYSTEM INTERFACE ${libwebsockets_include})
  target_link_libraries(graben_libwebsockets INTERFACE ${libwebsockets_library})
  find_path(libevdev_include libevdev/libevdev.h PATH_SUFFIXES libevdev-1.0 REQUIRED)
  find_library(libevdev_library evdev REQUIRED)
  add_library(graben_libevdev INTERFACE IMPORTED GLOBAL)
  target_include_directories(graben_libevdev SYSTEM INTERFACE ${libevdev_include})
  target_link_libraries(graben_libevdev INTERFACE ${libevdev_library})
  if(GRABEN_BENCH)
    find_package(benchmark REQUIRED)
    find_package(Boost 1.74 REQUIRED)
    find_package(PkgConfig REQUIRED)
    pkg_check_modules(NLOPT REQUIRED IMPORTED_TARGET nlopt)
    pkg_check_modules(IPOPT REQUIRED IMPORTED_TARGET ipopt)
  endif()
  return()
endif()

# A folder that holds nothing else: the C library's headers, which lie beside them, are not the
# target's.
set(headers ${PROJECT_BINARY_DIR}/headers_from_outside)
file(MAKE_DIRECTORY ${headers})

# graben_headers(TARGET FILE): FILE is the header that is looked for, from /usr/include.
function(graben_headers target file)
  find_path(found ${file} PATHS /usr/local/include /usr/include REQUIRED NO_CACHE
    NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH)
  cmake_path(GET file PARENT_PATH folder)
  file(CREATE_LINK ${found}/${folder} ${headers}/${folder} SYMBOLIC)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${headers})
endfunction()
graben_headers(CLI11::CLI11 CLI/CLI.hpp)
graben_headers(fmt::fmt fmt/core.h)
graben_headers(nlohmann_json::nlohmann_json nlohmann/json.hpp)
graben_headers(tomlplusplus::tomlplusplus toml++/toml.h)
graben_headers(graben_eigen_folder eigen3/signature_of_eigen3_matrix_library)
add_library(Eigen3::Eigen INTERFACE IMPORTED GLOBAL)
set_target_properties(Eigen3::Eigen PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${headers}/eigen3)
