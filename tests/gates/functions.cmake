# SPDX-License-Identifier: Apache-2.0
# How a gate and its canaries become tests. Wants the variables gates, seeds and python.

# graben_gate(NAME arguments...)
function(graben_gate name)
  add_test(NAME gate_${name} COMMAND ${python} ${gates}/${name}.py ${ARGN})
  set_tests_properties(gate_${name} PROPERTIES LABELS gate)
endfunction()

# graben_canary(NAME REGEX command...): the command has to fail, with output like the expression
function(graben_canary name regex)
  add_test(NAME canary_${name}
    COMMAND ${python} ${gates}/expect_refusal.py --expect "${regex}" -- ${ARGN})
  set_tests_properties(canary_${name} PROPERTIES LABELS gate)
endfunction()
