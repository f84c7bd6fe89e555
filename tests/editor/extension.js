// Usage: node extension.js ROOT
// The VS Code extension: its grammar on its tests, and its package.
'use strict';
const assert = require('assert');
const fs = require('fs');
const path = require('path');
const {spawnSync} = require('child_process');

const root = process.argv[2];
const here = path.join(__dirname, 'vscode');

function run(tool, ...words) {
  const done = spawnSync(path.join(__dirname, 'node_modules/.bin', tool), words,
                         {cwd: here, encoding: 'utf8'});
  return {status: done.status, output: `${done.stdout}${done.stderr}`};
}

function succeed(tool, ...words) {
  const {status, output} = run(tool, ...words);
  assert.strictEqual(status, 0, output);
  return output;
}

fs.rmSync(here, {recursive: true, force: true});
fs.cpSync(path.join(root, 'editors/vscode'), here, {
  recursive: true, filter: name => !name.includes('node_modules')});
fs.copyFileSync(path.join(root, 'LICENSE'), path.join(here, 'LICENSE'));

// What its README says to install is what is tested.
const theirs = JSON.parse(fs.readFileSync(path.join(here, 'package.json')));
const ours = JSON.parse(fs.readFileSync(path.join(__dirname, 'package.json')));
for (const [name, version] of Object.entries(theirs.devDependencies)) {
  assert.strictEqual(ours.dependencies[name], version, name);
}
const cmake = fs.readFileSync(path.join(root, 'CMakeLists.txt'), 'utf8');
assert.strictEqual(theirs.version, /rungproof VERSION ([\d.]+)/.exec(cmake)[1]);

const good = fs.readdirSync(path.join(here, 'tests')).map(it => `tests/${it}`);
assert.ok(good.length >= 2);
succeed('vscode-tmgrammar-test', ...good);
// A test that cannot fail would say nothing.
fs.writeFileSync(path.join(here, 'wrong.rung'),
                 '// SYNTAX TEST "source.rung" "wrong"\n\nQ0 = I0;\n' +
                     '// <- constant.numeric.rung\n');
assert.notStrictEqual(run('vscode-tmgrammar-test', 'wrong.rung').status, 0);
fs.rmSync(path.join(here, 'wrong.rung'));

// Editors start it with what is in the bundle alone.
const bundle = theirs.scripts.bundle.split(' ');
succeed(...bundle);
const code = fs.readFileSync(path.join(here, 'out/extension.js'), 'utf8');
const needed = new Set(
    [...code.matchAll(/\brequire\("([^"]+)"\)/g)].map(it => it[1]));
const builtin = require('module').builtinModules;
assert.deepStrictEqual(
    [...needed].filter(it => !builtin.includes(it.replace('node:', ''))),
    ['vscode']);
succeed('vsce', 'package', '--no-dependencies', '--allow-missing-repository',
        '-o', 'rungproof.vsix');
assert.ok(fs.statSync(path.join(here, 'rungproof.vsix')).size > 10000);
fs.rmSync(path.join(here, 'rungproof.vsix'));
const files = succeed('vsce', 'ls', '--no-dependencies').trim().split('\n');
assert.deepStrictEqual(files.sort(), [
  'LICENSE', 'README.md', 'language-configuration.json', 'out/extension.js',
  'package.json', 'syntaxes/rung.tmLanguage.json']);
console.log('ok extension');
