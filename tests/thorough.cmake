# SPDX-License-Identifier: Apache-2.0
# Tests that ./test leaves to --thorough, with what proves the same kind of thing on each day. They have the
# label `thorough`; ctest runs them as any other. Included before the tests are added.

# graben_thorough(WHAT_IS_LEFT TEST...)
function(graben_thorough left)
  set_property(GLOBAL APPEND PROPERTY graben_thorough ${ARGN})
endfunction()
set_property(GLOBAL PROPERTY graben_thorough)

# One canary a gate is enough to know that the gate is alive; each seed has one rule of it.
graben_thorough("canary_layering_plant"
  canary_layering_firmware canary_layering_relative canary_layering_hal canary_layering_platform
  canary_layering_controller canary_layering_runs canary_layering_wing canary_layering_common canary_layering_circle
  canary_layering_plant_triangle canary_layering_suffix canary_layering_macro canary_layering_heap
  canary_layering_threads canary_layering_plant_drives canary_layering_example_plant canary_layering_example_core
  canary_layering_deployed)
graben_thorough("canary_files_length"
  canary_files_short canary_files_small canary_files_small_many canary_files_small_gone canary_files_never_run
  canary_files_home canary_files_registry)
graben_thorough("canary_purity_malloc, canary_purity_accepts_pure"
  canary_purity_operator_new canary_purity_virtual_destructor canary_purity_pthread canary_purity_printf
  canary_purity_clock canary_purity_throw canary_purity_static_local canary_purity_writable_global
  canary_purity_static_local_unguarded canary_purity_unlisted canary_purity_empty)
graben_thorough("canary_readme_failing"
  canary_readme_hanging canary_readme_folders canary_readme_empty canary_readme_tests canary_readme_no_test)
graben_thorough("canary_tidy" canary_tidy_together canary_tidy_unity)
graben_thorough("canary_documents" canary_documents_empty)
graben_thorough("canary_memory_recursion"
  canary_memory_variable_array canary_memory_unlisted_call canary_memory_deep_chain canary_memory_big_image
  canary_memory_creep)
graben_thorough("canary_package_contents"
  canary_package_lintian canary_package_install canary_package_nowhere canary_package_nowhere_ci)
graben_thorough("canary_hil_panic"
  canary_hil_exit canary_hil_hang canary_hil_stuck canary_hil_library canary_hil_nowhere canary_hil_nowhere_ci
  canary_hil_no_kernel)
graben_thorough("canary_mutation_survivor, canary_mutation_weakened"
  canary_mutation_scopes canary_mutation_excuse canary_mutation_hanging canary_mutation_dead canary_mutation_red)
graben_thorough("canary_margins_gain" canary_margins_assumed canary_margins_lag)
graben_thorough("closed_loop_cells fails alike where the law is broken" canary_cells)

# The solver: its 306 reference cases under every policy, and 1836 results to the bit, are left.
graben_thorough("vectors_policies, vectors_bits"
  vectors_algorithm1 vectors_topologies vectors_pump_kinds fuzz_random_valves)
graben_thorough("margins_first: the first of the tables" margins)

# Whole runs of the tool.
graben_thorough("closed_loop_areas: one of nine" closed_loop_areas_every)
graben_thorough("closed_loop_areas" closed_loop_fixed_passes)
graben_thorough("closed_loop_autodig; unit tests of the load's observer" closed_loop_tip_load)
graben_thorough("closed_loop_bounds has both sizes" closed_loop_scaled)
graben_thorough("closed_loop_trench: the smallest and the largest" closed_loop_trench_every)
graben_thorough("closed_loop_designs, closed_loop_tilt" closed_loop_curves)
graben_thorough("unit_identify_*, unit_commission" cli_identify cli_identify_log)
graben_thorough("cli_drift" cli_drift_weeks)
graben_thorough("unit_learnt_valve, unit_oil_softness" cli_learning)
graben_thorough("unit_motion, unit_motion_csv, unit_motion_result" cli_verdict)

# The real binaries in a guest: one class of link each, and what only a kernel can break.
graben_thorough("hil_controllers, hil_faults" hil_dig hil_grade hil_autodig)
graben_thorough("unit_paused_dig in simulated time" hil_paused_dig canary_hil_paused_dig)
graben_thorough("fault_cases_* in simulated time" hil_plausible canary_hil_plausible hil_plausible_every)
graben_thorough("hours_few" hours hil_hours)
graben_thorough("timing_counts: instructions of a cycle" hil_timing canary_hil_timing)
graben_thorough("unit_ecu_store: writes dropped, halved, reordered" hil_power_cuts)
graben_thorough("unit_operate_*" hil_operate hil_first_metre hil_commission)

# The packages: what is in them is left.
graben_thorough("package_contents, package_tool_contents"
  package_roots package_install package_hardening package_tool_install)
graben_thorough("cli_campaign; unit tests of array jobs' files" cluster_slurm)
graben_thorough("export_mcap" export_film)
graben_thorough("scope_page, scope_people, scope_operator"
  scope_people_looks scope_closer_looks scope_alarms_looks scope_operator_looks)
