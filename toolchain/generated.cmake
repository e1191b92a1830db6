# SPDX-License-Identifier: Apache-2.0
# What is made of the frames' sources and of the code tables lies in the build folder from configuring on, so that no
# target waits for it. What comes out the same keeps its time: nothing is compiled again for it.
set(graben_generated ${PROJECT_BINARY_DIR}/generated)
file(GLOB rules CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/can_dbc/*.py ${PROJECT_SOURCE_DIR}/can_dbc/dbcgen/*.py
  ${PROJECT_SOURCE_DIR}/can_dbc/*.dbc.in ${PROJECT_SOURCE_DIR}/firmware/safety/*.toml)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${rules})
execute_process(COMMAND ${Python3_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/can_dbc/generate_all.py
    --built ${graben_generated}
  COMMAND_ERROR_IS_FATAL ANY)
include_directories(${graben_generated})
