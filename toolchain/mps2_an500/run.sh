#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Runs a program for the Cortex-M7 on QEMU's board mps2-an500: run.sh PROGRAM [ARGUMENT...]
# Arguments, files, output and the exit status (0 or 1) go by semihosting. QEMU_PLUGIN names a plugin
# with its arguments, as it does for QEMU's user mode.
set -eu

program=$1
config=enable=on,target=native,arg=$program
shift
for argument in "$@"; do
  case $argument in
    *[,\ ]*)
      echo "run.sh: '$argument': neither commas nor blanks pass to the board" >&2
      exit 2
      ;;
  esac
  config=$config,arg=$argument
done
exec qemu-system-arm ${QEMU_PLUGIN:+-plugin "$QEMU_PLUGIN"} -M mps2-an500 -nographic -monitor none -serial none -semihosting-config "$config" \
  -kernel "$program" </dev/null
