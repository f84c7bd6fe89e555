// Usage: node validate.js REPORT_DIR DOCS
//
// Reads NAME.sarif, .json, .jsonl, .gitlab, .github, .baseline, .config (TOML as
// JSON) of a directory, each with what somebody else has to say of its format. Before, every validator is
// seen to refuse a broken report: one that takes all would say nothing.
'use strict';
const fs = require('fs');
const path = require('path');
const Ajv = require('ajv');
const Ajv4 = require('ajv-draft-04');
const addFormats = require('ajv-formats');
const github = require('./github.js');

const [reports, docs] = process.argv.slice(2);
const read = file => JSON.parse(fs.readFileSync(file, 'utf8'));

function validator(schema, Validator, options) {
  const ajv = new Validator({allErrors: true, strict: false, ...options});
  addFormats(ajv);
  const validate = ajv.compile(schema);
  return json => validate(json) ? [] :
                 validate.errors.map(e => `${e.instancePath} ${e.message}`);
}

const ofSarif = validator(
    read(path.join(
        __dirname, 'node_modules/@microsoft/jest-sarif/lib/schemas',
        'sarif-2.1.0-rtm.5.json')),
    Ajv4, {unicodeRegExp: false});
const ofResult = validator(read(path.join(docs, 'schemas', 'result.json')), Ajv);
const ofEvent = validator(read(path.join(docs, 'schemas', 'events.json')), Ajv);
const ofBaseline = validator(read(path.join(docs, 'schemas', 'baseline.json')), Ajv);
const ofGitlab = validator(read(path.join(__dirname, 'gitlab.schema.json')), Ajv);

const ofConfig = validator(read(path.join(docs, 'rungproof.schema.json')), Ajv);

function checkConfig(text) {
  return ofConfig(JSON.parse(text));
}

function checkSarif(text) {
  return ofSarif(JSON.parse(text));
}

function checkJson(text) {
  return ofResult(JSON.parse(text));
}

function checkBaseline(text) {
  return ofBaseline(JSON.parse(text));
}

function checkJsonl(text) {
  const events = text.trimEnd().split('\n').map(line => JSON.parse(line));
  const found = events.flatMap(ofEvent);
  const names = events.map(one => one.event);
  if (names.indexOf('start') !== 0 || names.lastIndexOf('start') !== 0) {
    found.push('`start` is not the first event, or not the only one');
  }
  if (names.indexOf('summary') !== names.length - 1) {
    found.push('`summary` is not the last event, or not the only one');
  }
  return found;
}

function checkGitlab(text) {
  const issues = JSON.parse(text);
  const found = ofGitlab(issues);
  const prints = new Set(issues.map(one => one.fingerprint));
  if (prints.size !== issues.length) found.push('fingerprints are not unique');
  return found;
}

const kinds = {
  '.sarif': checkSarif,
  '.json': checkJson,
  '.jsonl': checkJsonl,
  '.gitlab': checkGitlab,
  '.github': github.problems,
  '.baseline': checkBaseline,
  '.config': checkConfig,
};

// What differs from a good report by one thing that its readers need.
function broken(kind, text) {
  if (kind === '.github') {
    return [
      text.slice(2), text.replace('::', '::debug '), text.trimEnd(),
      text.replace(/line=\d+/, 'line=0'), text.replace(/title=/, 'tilte='),
      text.replace(/,endLine=\d+/, ',endLine=99999'),
      text.replace(/::([^:\n]*)\n/, '::\n'),
    ];
  }
  if (kind === '.jsonl') {
    const lines = text.trimEnd().split('\n');
    return [
      lines.slice(1).join('\n'), lines.slice(0, -1).join('\n'),
      lines.map(line => line.replace('"event"', '"evnt"')).join('\n'),
    ];
  }
  if (kind === '.config') {
    const wrong = [
      {rule: {}}, {baseline: ''}, {exclude: 'a'}, {check: {scans: '1..5'}},
      {check: {scan: 5}}, {check: {'fail-on': 'never'}}, {check: {timeout: 0}},
      {rules: {packs: 'safety'}}, {rules: {packs: ['extra']}},
      {rules: {'double-coli': 'off'}}, {rules: {'double-coil': 'fatal'}},
      {rules: {RP999: 'off'}},
    ];
    return wrong.map(one => JSON.stringify({...JSON.parse(text), ...one}));
  }
  const all = [];
  const visit = (json, root) => {
    if (json === null || typeof json !== 'object') return;
    for (const key of Object.keys(json)) {
      const value = json[key];
      if (!Array.isArray(json) && MUST[kind].includes(key)) {
        delete json[key];
        all.push(JSON.stringify(root));
        json[key] = value;
      }
      visit(value, root);
    }
  };
  const json = JSON.parse(text);
  visit(json, json);
  return all;
}

const MUST = {
  '.sarif': ['runs', 'tool', 'driver', 'text'],
  '.json': ['schema', 'code', 'range', 'line', 'verdict', 'exit_status',
            'signals', 'waiver', 'reason', 'summary'],
  '.gitlab': ['description', 'fingerprint', 'severity', 'location', 'begin'],
  '.baseline': ['schema', 'file', 'code', 'fingerprint', 'findings'],
};

let bad = 0;
const seen = {};
for (const file of fs.readdirSync(reports).sort()) {
  const kind = path.extname(file);
  const check = kinds[kind];
  if (check === undefined) continue;
  const text = fs.readFileSync(path.join(reports, file), 'utf8');
  seen[kind] = (seen[kind] || 0) + 1;
  for (const what of check(text)) {
    ++bad;
    console.error(`${file}: ${what}`);
  }
  for (const wrong of broken(kind, text)) {
    if (wrong === text || check(wrong).length > 0) continue;
    ++bad;
    console.error(`${file}: the validator takes a broken report:\n${wrong.slice(0, 300)}`);
    break;
  }
}
for (const kind of Object.keys(kinds)) {
  console.log(`${kind}: ${seen[kind] || 0} reports checked`);
  if (!seen[kind]) ++bad;
}
process.exit(bad > 0 ? 1 : 0);
