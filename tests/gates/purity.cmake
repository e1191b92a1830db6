# SPDX-License-Identifier: Apache-2.0
# The gates that judge the core as the target's compiler makes it, on every target: what its archives
# need, what its sources find. Wants functions.cmake.

graben_gate(purity --nm ${CMAKE_NM} $<TARGET_FILE:graben_firmware> $<TARGET_FILE:graben_hal>)
function(graben_purity_seed seed)  # one of tests/canary/purity, for whoever builds what the gates need
  add_library(canary_purity_${seed} STATIC ${seeds}/purity/${seed}.cpp)
  foreach(group quick_tests target_basics)
    if(TARGET ${group})
      add_dependencies(${group} canary_purity_${seed})
    endif()
  endforeach()
endfunction()
# graben_purity_canary(SEED REGEX): the seed is compiled as strangers would, exceptions and all
function(graben_purity_canary seed regex)
  graben_purity_seed(${seed})
  graben_canary(purity_${seed} "${regex}"
    ${python} ${gates}/purity.py --nm ${CMAKE_NM} $<TARGET_FILE:canary_purity_${seed}>)
endfunction()
graben_purity_canary(malloc "malloc.cpp.o.* needs malloc: heap")
graben_purity_canary(operator_new "needs operator new\\[\\]\\(unsigned (int|long)\\): heap")
graben_purity_canary(virtual_destructor "needs operator delete.*: heap .a virtual destructor")
graben_purity_canary(pthread "needs pthread_create: threads")
graben_purity_canary(printf "needs printf: stdio")
graben_purity_canary(clock "needs clock_gettime: clock")
graben_purity_canary(throw "needs __cxa_throw: exceptions")
graben_purity_canary(static_local "needs __cxa_guard_acquire: globals")
graben_purity_canary(writable_global "keeps cycles in .bss: writable global")
# As the core is compiled: without the guard's functions, the guard itself is left to be found.
graben_purity_canary(static_local_unguarded "keeps guard variable for refused..::kept in .bss")
target_compile_options(canary_purity_static_local_unguarded PRIVATE -fno-threadsafe-statics)
graben_purity_canary(unlisted "needs getpid: not on the list")
graben_purity_canary(empty "has no code: the gate is dead")
# And the other way: what is pure has to pass.
graben_purity_seed(pure)
target_compile_options(canary_purity_pure PRIVATE -fno-exceptions -fno-rtti)
add_test(NAME canary_purity_accepts_pure
  COMMAND ${python} ${gates}/purity.py --nm ${CMAKE_NM} $<TARGET_FILE:canary_purity_pure>)
set_tests_properties(canary_purity_accepts_pure PROPERTIES LABELS gate)

get_target_property(eigen_folder Eigen3::Eigen INTERFACE_INCLUDE_DIRECTORIES)
get_directory_property(target_options COMPILE_OPTIONS)
set(target_compiler -- ${CMAKE_CXX_COMPILER} ${target_options} -isystem ${eigen_folder}
  -DEIGEN_NO_MALLOC -DEIGEN_DONT_VECTORIZE)
graben_gate(shadow --root ${PROJECT_SOURCE_DIR} ${target_compiler} -I${graben_generated})
graben_canary(shadow "<map> is not for the core.*<sys/time.h> is not.*<vector> is not"
  ${python} ${gates}/shadow.py --root ${seeds}/shadow ${target_compiler})
