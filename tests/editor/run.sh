#!/bin/sh
# Usage: run.sh NPM NODE BUILD_DIR SCRIPT ARGUMENT...
#
# Installs the packages of this folder into BUILD_DIR, once, and runs SCRIPT
# there. Exit 77 (skipped, loudly) when they cannot be had.
set -u
npm=$1
node=$2
build=$3
script=$4
shift 4
here=$(cd "$(dirname "$0")" && pwd)

mkdir -p "$build"
cp "$here/package.json" "$here"/*.js "$build/"
if ! cmp -s "$build/package.json" "$build/installed.json"; then
  if ! "$npm" install --prefix "$build" --no-audit --no-fund --ignore-scripts \
       --loglevel=error; then
    echo "SKIPPED: npm cannot install its packages: $script did NOT run"
    # In CI the packages must be there.
    [ -n "${CI:-}" ] && exit 1
    exit 77
  fi
  cp "$build/package.json" "$build/installed.json"
fi
exec "$node" "$build/$script" "$@"
