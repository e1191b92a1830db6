#!/bin/sh
# pack.sh BUILD OUT: the Debian package of graben-ecu as built in BUILD, into OUT; prints its path.
# The same program gives the same package, byte by byte: its times are the changelog's.
set -eu

root=$(dirname -- "$(dirname -- "$(readlink -f -- "$0")")")
build=$(readlink -f -- "$1")
mkdir -p "$2"
out=$(readlink -f -- "$2")
SOURCE_DATE_EPOCH=$(dpkg-parsechangelog -l "$root/app/ecu/package/changelog" -STimestamp)
export SOURCE_DATE_EPOCH
umask 022
# Packed aside and moved: two at once must not meet, and nothing half done has the final name.
work=$(mktemp -d "$out/pack.XXXXXX")
trap 'rm -rf "$work"' EXIT
if ! cpack -G DEB --config "$build/CPackConfig.cmake" -B "$work" >"$work/log" 2>&1; then
  cat "$work/log" >&2
  exit 1
fi
for package in "$work"/*.deb; do
  mv "$package" "$out/"
  echo "$out/${package##*/}"
done
