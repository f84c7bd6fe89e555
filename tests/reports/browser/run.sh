#!/bin/sh
# Usage: run.sh NPM NODE CHROMIUM BUILD_DIR RUNGPROOF
#
# Installs the packages into BUILD_DIR, once, writes reports with RUNGPROOF and
# looks at them in CHROMIUM. Exit 77 (skipped, loudly) when the packages cannot
# be had.
set -u
npm=$1
node=$2
chromium=$3
build=$4
rungproof=$5
here=$(cd "$(dirname "$0")" && pwd)

mkdir -p "$build"
cp "$here/package.json" "$here"/*.js "$build/"
if ! cmp -s "$build/package.json" "$build/node_modules/installed.json"; then
  if ! "$npm" install --prefix "$build" --no-audit --no-fund --ignore-scripts \
       --loglevel=error; then
    echo "SKIPPED: npm cannot install playwright-core: the HTML reports were" \
         "NOT tested in a browser"
    # In CI the packages must be there.
    [ -n "${CI:-}" ] && exit 1
    exit 77
  fi
  cp "$build/package.json" "$build/node_modules/installed.json"
fi
exec "$node" "$build/main.js" "$chromium" "$rungproof"
