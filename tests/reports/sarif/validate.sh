#!/bin/sh
# Usage: validate.sh NPM NODE BUILD_DIR GOLDEN_DIR
#
# Installs the validator into BUILD_DIR, once, and checks the `--- sarif`
# section of every golden. Exit 77 (skipped, loudly) when the packages cannot be
# had; a report that the schema refuses is a failure.
set -u
npm=$1
node=$2
build=$3
goldens=$4
here=$(cd "$(dirname "$0")" && pwd)

mkdir -p "$build"
cp "$here/package.json" "$here/validate.js" "$build/"
if [ ! -d "$build/node_modules/@microsoft/jest-sarif" ]; then
  if ! "$npm" install --prefix "$build" --no-audit --no-fund --ignore-scripts \
       --loglevel=error; then
    echo "SKIPPED: npm cannot install the validator: the SARIF reports were NOT" \
         "checked against the schema"
    # In CI the packages must be there.
    [ -n "${CI:-}" ] && exit 1
    exit 77
  fi
fi
exec "$node" "$build/validate.js" "$goldens"
