#!/bin/sh
# Usage: run.sh NPM SOURCE_DIR BUILD_DIR COMMAND...
#
# Copies the scripts of SOURCE_DIR into BUILD_DIR, installs the packages of its
# package.json there, once, and runs COMMAND. Exit 77 (skipped, loudly) when the
# packages cannot be had; in CI that is a failure.
set -u
npm=$1
source=$2
build=$3
shift 3

mkdir -p "$build"
cp "$source"/*.js* "$build/"
if ! cmp -s "$build/package.json" "$build/node_modules/installed.json"; then
  if ! "$npm" install --prefix "$build" --no-audit --no-fund --ignore-scripts \
       --loglevel=error; then
    echo "SKIPPED: npm cannot install the packages: the test did NOT run"
    [ -n "${CI:-}" ] && exit 1
    exit 77
  fi
  cp "$build/package.json" "$build/node_modules/installed.json"
fi
exec "$@"
