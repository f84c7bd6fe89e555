// Usage: node multitool.js MULTITOOL REPORT_DIR
//
// The SARIF reports under the rules of SARIF and of GitHub's code scanning. The
// tool's exit status says nothing: its log is read.
'use strict';
const {spawnSync} = require('child_process');
const fs = require('fs');
const path = require('path');

const [tool, reports] = process.argv.slice(2);

// SARIF2005: a page about the tool in the web. We name no host.
const ACCEPTED = ['SARIF2005'];

// "RULE level: place" of all that is worse than a note.
function complaints(files) {
  const log = path.join(reports, 'multitool.log');
  fs.rmSync(log, {force: true});
  const run = spawnSync(
      tool,
      ['validate', ...files, '--rule-kind', 'Sarif;Ghas', '--level',
       'Error;Warning;Note', '--log', 'ForceOverwrite', '-o', log],
      {encoding: 'utf8'});
  if (!fs.existsSync(log)) throw new Error(run.error || run.stdout + run.stderr);
  if (!run.stdout.includes(`${files.length} files scanned`)) {
    throw new Error(`not all of ${files.length} files were read: ${run.stdout}`);
  }
  const found = [];
  for (const result of JSON.parse(fs.readFileSync(log, 'utf8')).runs[0].results) {
    const level = result.level || 'warning';
    if (level === 'note' || ACCEPTED.includes(result.ruleId)) continue;
    const place = result.locations[0].physicalLocation;
    found.push(`${result.ruleId} ${level}: ${place.artifactLocation.uri}:` +
               `${place.region.startLine} ${JSON.stringify(result.message)}`);
  }
  return found;
}

// One that GitHub refuses must be told.
// It reads no file that is not called .sarif, and says nothing of that.
const sample = path.join(reports, 'broken', 'x.sarif');
fs.mkdirSync(path.dirname(sample), {recursive: true});
const json = JSON.parse(fs.readFileSync(path.join(reports, 'run.sarif'), 'utf8'));
delete json.runs[0].results[0].locations;
fs.writeFileSync(sample, JSON.stringify(json));
if (complaints([sample]).length === 0) {
  console.error('multitool takes a result without a location');
  process.exit(1);
}

const files = fs.readdirSync(reports).filter(name => name.endsWith('.sarif'));
const found = complaints(files.map(name => path.join(reports, name)));
for (const what of found) console.error(what);
console.log(`${files.length} SARIF reports read by sarif-multitool`);
process.exit(files.length === 0 || found.length > 0 ? 1 : 0);
