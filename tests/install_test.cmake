# SPDX-License-Identifier: GPL-2.0-or-later
# Installs the build, moves the tree and runs the moved lmp on the installed decks:
#   cmake -DBUILD=... -DWORK=... -P install_test.cmake
file(REMOVE_RECURSE ${WORK})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/here
                COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
file(RENAME ${WORK}/here ${WORK}/there)
execute_process(
  COMMAND ${WORK}/there/bin/lmp -in in.fill -var rods 10 -var fill_time 0.001 -var out ${WORK}
          -log none
  WORKING_DIRECTORY ${WORK}/there/share/spherocylinder/input
  COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE output)
if(NOT EXISTS ${WORK}/restart.fill OR NOT output MATCHES "inserted 10 particle templates")
  message(FATAL_ERROR "the moved lmp did not place 10 rods:\n${output}")
endif()
