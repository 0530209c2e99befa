# Tests of the build itself, in plain builds only: the objects of sanitized ones hold more than ours.
if(LANECAST_SANITIZE)
  return()
endif()
find_program(LANECAST_PYTHON python3)
find_program(LANECAST_QEMU qemu-x86_64)

# lanecast_script_test(<name> <command>...): exit status 77 means skipped, with the reason printed.
function(lanecast_script_test name)
  add_test(NAME ${name} COMMAND ${ARGN} WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
  set_tests_properties(${name} PROPERTIES LABELS unit SKIP_RETURN_CODE 77)
endfunction()

if(LANECAST_PYTHON)
  lanecast_script_test(check_includes ${LANECAST_PYTHON} tools/check_includes.py)
  lanecast_script_test(check_includes_self_test ${LANECAST_PYTHON} tests/tools/check_includes_test.py)
  lanecast_script_test(docs_links ${LANECAST_PYTHON} tests/tools/docs_links_test.py)
  lanecast_script_test(make_meshes_self_test ${LANECAST_PYTHON} tests/tools/make_meshes_test.py)
  lanecast_script_test(spd_nff ${LANECAST_PYTHON} tests/tools/spd_nff_test.py)
  lanecast_script_test(povray_self_test ${LANECAST_PYTHON} tests/tools/povray_test.py)
endif()
lanecast_script_test(check_isa_objects tools/check_isa_objects.sh ${CMAKE_BINARY_DIR}/isa_objects.txt)
lanecast_script_test(check_isa_objects_self_test
  tests/tools/check_isa_objects_test.sh ${CMAKE_SOURCE_DIR} ${CMAKE_CXX_COMPILER})
lanecast_script_test(install tests/install/install_test.sh
  ${CMAKE_SOURCE_DIR} ${CMAKE_BINARY_DIR} ${CMAKE_COMMAND} ${CMAKE_CXX_COMPILER})
if(LANECAST_QEMU)
  lanecast_script_test(qemu_nehalem tests/tools/qemu_test.sh ${LANECAST_QEMU} ${CMAKE_SOURCE_DIR} ${CMAKE_BINARY_DIR})
endif()
