// The programs whose reports the tests look at, and the reports.
'use strict';
const assert = require('assert');
const fs = require('fs');
const os = require('os');
const path = require('path');
const {spawnSync} = require('child_process');

const motor = `//@ scan 100..100 ms
//@ stop: always I1 -> !Q0
//@ warm: never Q1 && !I0
//@ runs: reach Q0 && !I0
//@ apart: never Q2 && Q3
Q0 = (I0 || Q0 && !I1);
Q1 = T(0, 60, Q0) && IW0 < 20;
Q2 = I2 && !Q3;
Q3 = I3 && !Q2;
`;
const other = motor.replace('(I0 || Q0 && !I1)', '(I0 || Q0) && !I1');

/** 250 seal-in rungs, half of them wrong, with two properties each. */
function many() {
  let text = '//@ scan 100..100 ms\n';
  for (let i = 0; i < 250; ++i) {
    const [start, stop, coil] = [`start${i}`, `stop${i}`, `run${i}`];
    text += `//@ input ${start}\n//@ input ${stop}\n` +
        `//@ stops${i}: always ${stop} -> !${coil}\n` +
        `//@ starts${i}: reach ${coil}\n`;
    text += i % 2 === 0 ? `${coil} = (${start} || ${coil}) && !${stop};\n` :
                          `${coil} = ${start} || ${coil} && !${stop};\n`;
  }
  return text;
}

class Scenes {
  constructor(rungproof) {
    this.rungproof = rungproof;
    this.directory = fs.mkdtempSync(path.join(os.tmpdir(), 'rungproof-'));
  }

  remove() { fs.rmSync(this.directory, {recursive: true}); }

  file(name) { return path.join(this.directory, name); }

  url(name, hash = '') { return `file://${this.file(name)}${hash}`; }

  json(name) { return JSON.parse(fs.readFileSync(this.file(name), 'utf8')); }

  /** Writes `files`, runs the command on them. */
  write(files, status, ...words) {
    for (const [name, text] of Object.entries(files)) {
      fs.mkdirSync(path.dirname(this.file(name)), {recursive: true});
      fs.writeFileSync(this.file(name), text);
    }
    const done = spawnSync(this.rungproof, words,
                           {cwd: this.directory, encoding: 'utf8'});
    assert.strictEqual(done.status, status,
                       `${words.join(' ')}: ${done.stdout}${done.stderr}`);
    return done;
  }

  make() {
    this.write({'motor.rung': motor}, 1, 'check', 'motor.rung', '--format',
               'html:motor.html', '--format', 'json:motor.json');
    this.write({'a.rung': motor, 'b.rung': other}, 1, 'equiv', 'a.rung',
               'b.rung', '--format', 'html:equiv.html');
    this.write({}, 1, 'prove', 'motor.rung', '--traces', 'traces');
    const hostile = '<\u202e/script><img src=x onerror=alert(1)>&amp;\'".rung';
    this.write({[hostile]: motor}, 1, 'check', hostile, '--format',
               'html:hostile.html');
    this.write({'many.rung': many()}, 1, 'prove', 'many.rung', '--format',
               'html:many.html');
  }
}

module.exports = {Scenes};
