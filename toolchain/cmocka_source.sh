#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# CMocka's source for the machines that Debian has no package of it for: cmocka_source.sh FOLDER
# Debian's source package by the mirror that this machine's apt uses, verified by Debian's
# keys, with lists of its own in FOLDER. Nothing when it is there already; delete FOLDER to get it again.
set -eu

folder=$1
if [ -e "$folder/src/cmocka.c" ]; then
  exit 0
fi
release=bookworm
mkdir -p "$folder/lists/partial" "$folder/cache/archives/partial"
folder=$(readlink -f -- "$folder")

keys=/usr/share/keyrings/debian-archive-keyring.gpg
# shellcheck disable=SC2016 # apt's own variables
apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' "Release: $release" \
  'Component: main' 'Created-By: Packages' |
  sort -u | sed -n "1s|^|deb-src [signed-by=$keys] |p" >"$folder/sources.list"
if ! [ -s "$folder/sources.list" ]; then
  echo "cmocka_source.sh: this machine's apt knows no mirror of $release" >&2
  exit 1
fi

apt() {
  apt-get -q -o Dir::Etc::SourceList="$folder/sources.list" -o Dir::Etc::SourceParts=- \
    -o Dir::State::Lists="$folder/lists" -o Dir::Cache="$folder/cache" \
    -o Acquire::Languages=none -o APT::Sandbox::User= "$@" </dev/null
}
cd "$folder"
apt update
apt source --download-only cmocka
tar -xJf cmocka_*.orig.tar.xz --strip-components=1 --wildcards '*/src/cmocka.c' \
  '*/include/cmocka*.h' '*/COPYING'
rm -rf lists cache
