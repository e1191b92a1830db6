# SPDX-License-Identifier: Apache-2.0
# graben_sources(VAR FOLDER...): the sources in these folders of the current one, "." itself. A new file is
# in the build by being there.
function(graben_sources var)
  set(patterns)
  foreach(folder ${ARGN})
    list(APPEND patterns ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp)
  endforeach()
  file(GLOB found RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS ${patterns})
  set(${var} ${found} PARENT_SCOPE)
endfunction()
