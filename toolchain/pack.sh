#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# pack.sh BUILD OUT [tool]: the Debian package of graben-ecu as built in BUILD, or that of graben, into OUT;
# prints its path. The same program gives the same package, byte by byte: its times are the changelog's.
set -eu

root=$(dirname -- "$(dirname -- "$(readlink -f -- "$0")")")
build=$(readlink -f -- "$1")
mkdir -p "$2"
out=$(readlink -f -- "$2")
config=CPackConfig.cmake
changelog=app/ecu/package/changelog
if [ "${3-}" = tool ]; then
  config=CPackToolConfig.cmake
  changelog=app/cli/package/changelog
fi
SOURCE_DATE_EPOCH=$(dpkg-parsechangelog -l "$root/$changelog" -STimestamp)
export SOURCE_DATE_EPOCH
umask 022
# Packed aside and moved: two at once must not meet, and nothing half done has the final name.
work=$(mktemp -d "$out/pack.XXXXXX")
trap 'rm -rf "$work"' EXIT
if ! cpack -G DEB --config "$build/$config" -B "$work" >"$work/log" 2>&1; then
  cat "$work/log" >&2
  exit 1
fi
for package in "$work"/*.deb; do
  mv "$package" "$out/"
  echo "$out/${package##*/}"
done
