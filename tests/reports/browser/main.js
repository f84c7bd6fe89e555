// Usage: node main.js CHROMIUM RUNGPROOF [TEST]
// Looks at reports in one browser; every function of tests.js is a test.
'use strict';
const {chromium} = require('playwright-core');
const {Scenes} = require('./scenes');
const tests = require('./tests');

const kFlags = [
  '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
  '--disable-background-networking', '--disable-component-update',
  '--disable-sync'];

async function main() {
  const [program, rungproof, only] = process.argv.slice(2);
  const chosen = Object.entries(tests).filter(
      ([name]) => only === undefined || name === only);
  const scenes = new Scenes(rungproof);
  const browser =
      await chromium.launch({executablePath: program, args: kFlags});
  let failed = 0;
  try {
    scenes.make();
    for (const [name, test] of chosen) {
      try {
        await test(browser, scenes);
        console.log(`ok      ${name}`);
      } catch (error) {
        ++failed;
        console.log(`FAILED  ${name}\n${error.stack}`);
      }
    }
  } finally {
    await browser.close();
    scenes.remove();
  }
  const count = chosen.length;
  console.log(`${count} tests, ${failed} failed`);
  process.exit(failed > 0 || count === 0 ? 1 : 0);
}

main().catch(error => {
  console.error(error);
  process.exit(1);
});
