#!/bin/sh
# Usage: validate.sh NODE PYTHON BUILD_DIR PROGRAM
#
# What others have to say about our reports: the goldens', and those of a run on
# a small plant with every format at once, by the validators in BUILD_DIR. A
# report that one of them refuses is a failure.
set -u
node=$1
python=$2
build=$3
program=$4
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../.." && pwd)

if ! "$python" -c 'import junitparser' 2>/dev/null; then
  echo "SKIPPED: no python3-junitparser: the reports were NOT checked"
  [ -n "${CI:-}" ] && exit 1
  exit 77
fi
multitool=$build/node_modules/@microsoft/sarif-multitool-linux/Sarif.Multitool
chmod +x "$multitool"

# The sections of the goldens as files.
reports=$build/reports
rm -rf "$reports"
mkdir -p "$reports"
for golden in "$here"/../golden/*.report; do
  awk -v base="$reports/$(basename "$golden" .report)" '
    /^--- / { out = base "." substr($0, 5); next }
    out != "" { print > out }' "$golden"
done

# A run with everything: findings, allowed and known ones, each kind of verdict.
plant=$build/plant
rm -rf "$plant"
cp -R "$here/plant" "$plant"
cd "$plant" || exit 1
"$program" baseline write old > /dev/null || exit 1
cp known.json "$reports/run.baseline"
mv new.rung old/motor.rung
"$program" check . --explain --jobs 2 --format "json:$reports/run.json" \
  --format "jsonl:$reports/run.jsonl" --format "sarif:$reports/run.sarif" \
  --format "junit:$reports/run.junit" --format "github:$reports/run.github" \
  --format "gitlab:$reports/run.gitlab" > /dev/null
status=$?
[ "$status" = 2 ] || { echo "the run ends in $status, not in 2"; exit 1; }

# Configurations: that of the plant and the one in the documentation.
sed -n '/^    baseline = /,/^| key/ s/^    //p' "$root/docs/configuration.md" \
  > "$build/example.toml"
for toml in "$build/example.toml" "$plant/rungproof.toml"; do
  "$program" lint --config "$toml" --baseline "$reports/run.baseline" \
    "$plant/proofs.rung" > /dev/null
  [ $? -lt 2 ] || { echo "$toml is refused"; exit 1; }
  "$python" -c 'import json, sys, tomllib
json.dump(tomllib.load(open(sys.argv[1], "rb")), sys.stdout)' "$toml" \
    > "$reports/$(basename "$toml" .toml).config" || exit 1
done

failed=0
"$node" "$build/validate.js" "$reports" "$root/docs" || failed=1
DOTNET_SYSTEM_GLOBALIZATION_INVARIANT=1 \
  "$node" "$build/multitool.js" "$multitool" "$reports" || failed=1
"$python" "$here/junit.py" "$reports" || failed=1
exit "$failed"
