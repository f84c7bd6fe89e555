// Usage: node validate.js GOLDEN_DIR
// Every `--- sarif` section of the *.report files must be valid SARIF 2.1.0.
'use strict';
const fs = require('fs');
const path = require('path');
const Ajv = require('ajv-draft-04');
const addFormats = require('ajv-formats');

const schemas = path.join(
    __dirname, 'node_modules/@microsoft/jest-sarif/lib/schemas');
const schema = JSON.parse(fs.readFileSync(
    path.join(schemas, 'sarif-2.1.0-rtm.5.json'), 'utf8'));
const ajv = new Ajv({unicodeRegExp: false, allErrors: true, strict: false});
addFormats(ajv);
const validate = ajv.compile(schema);

function sections(text, name) {
  const found = [];
  let current = null;
  for (const line of text.split('\n')) {
    if (line.startsWith('--- ')) {
      current = line.slice(4) === name ? [] : null;
      if (current) found.push(current);
    } else if (current) {
      current.push(line);
    }
  }
  return found.map(lines => lines.join('\n'));
}

// A validator that accepts everything would make this test say nothing.
if (validate({version: '2.1.0', runs: [{tool: {}, results: 1}]})) {
  console.error('the validator accepts a broken report');
  process.exit(1);
}

const directory = process.argv[2];
let checked = 0;
let bad = 0;
for (const file of fs.readdirSync(directory).sort()) {
  if (!file.endsWith('.report')) continue;
  const text = fs.readFileSync(path.join(directory, file), 'utf8');
  for (const sarif of sections(text, 'sarif')) {
    ++checked;
    if (validate(JSON.parse(sarif))) continue;
    ++bad;
    console.error(`${file}:`, JSON.stringify(validate.errors, null, 2));
  }
}
console.log(`${checked} SARIF reports checked against the schema, ${bad} bad`);
process.exit(checked === 0 || bad > 0 ? 1 : 0);
