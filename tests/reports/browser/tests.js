// What a reader must be able to do with a report.
'use strict';
const assert = require('assert');
const fs = require('fs');
const wavedrom = require('wavedrom');
const skins = require('wavedrom/skins/default.js');
const axe = require.resolve('axe-core');

/** Opens a page; whatever it loads, or complains of, is a failure. */
async function open(browser, url, act, options = {}) {
  const context = await browser.newContext(options);
  const trouble = [];
  try {
    const page = await context.newPage();
    page.on('console', message => {
      if (message.type() === 'error') trouble.push(message.text());
    });
    page.on('pageerror', error => trouble.push(String(error)));
    page.on('dialog', dialog => {
      trouble.push(`a dialog: ${dialog.message()}`);
      dialog.dismiss();
    });
    page.on('request', request => {
      if (request.url().split('#')[0] !== url.split('#')[0]) {
        trouble.push(`a request of ${request.url()}`);
      }
    });
    await page.goto(url);
    const answer = await act(page);
    assert.deepStrictEqual(trouble, []);
    return answer;
  } finally {
    await context.close();
  }
}

const kStop = '#file-1-obligation-1';

/** What the page is to say of the JSON's trace: at the end of `scan`. */
function expected(trace, names, scan) {
  const at = trace.steps.findIndex(step => step.scan >= scan);
  const values = trace.steps[at].values;
  const before = at === 0 ? null : trace.steps[at - 1].values;
  return {values: Object.fromEntries(names.map(name => [name, values[name]])),
          before};
}

/** "Scan 2, 200 ms. Changed: I0 = 0. Q0 = 1." as {scan, values, changed}. */
function parse_live(text) {
  const values = {};
  for (const [, name, value] of text.matchAll(/(\w+) = (-?\d+)/g)) {
    values[name] = Number(value);
  }
  const changed = /Changed: ([^.]*)\./.exec(text);
  return {scan: Number(/^Scan (\d+),/.exec(text)[1]), values,
          changed: changed ? changed[1] : ''};
}

async function look(page, id) {
  const run = page.locator(`${id} .run`);
  const live = parse_live(await run.locator('output').textContent());
  const row = run.locator('tr[aria-current]');
  assert.strictEqual(await row.count(), 1);
  return {
    ...live,
    row: (await row.locator('th').textContent()).replace(/^.*-/, ''),
    symbols: await run.locator('figure').first().evaluate(figure => [
      ...figure.querySelectorAll('g[data-kind]')].map(
          g => [...g.querySelectorAll('text')].map(t => t.textContent))),
    coil_on: await run.locator('figure').first().evaluate(figure => {
      const coil = figure.querySelector('g[data-kind="coil"]').dataset.from;
      return figure.querySelector(`[data-net="${coil}"]`).matches('.on');
    }),
    why: await run.locator('.why').first().textContent(),
    cursor: await run.locator('.plot .cursor').evaluate(
        rect => Number(rect.getAttribute('x'))),
  };
}

/** Ladder, table, diagram and words, at the scan that the trace has. */
function check_scan(seen, trace, scan) {
  const names = Object.keys(seen.values);
  assert.ok(names.length > 1);
  const {values, before} = expected(trace, names, scan);
  assert.strictEqual(seen.scan, scan);
  assert.strictEqual(Number(seen.row), scan);
  assert.deepStrictEqual(seen.values, values);
  for (const name of names) {
    if (before === null) continue;
    assert.strictEqual(seen.changed.includes(`${name} = `),
                       values[name] !== before[name], name);
  }
  for (const [name, value] of seen.symbols) {
    if (name in values && name !== 'Q0') {
      assert.strictEqual(Number(value), values[name], name);
    }
  }
  const [coil, value] = seen.symbols[seen.symbols.length - 1];
  assert.strictEqual(Number(value), values[coil]);
  assert.strictEqual(seen.coil_on, values[coil] === 1);
  const reached = seen.why.startsWith(`Power reaches ${coil}: `);
  assert.strictEqual(reached, values[coil] === 1, seen.why);
}

async function keys_step(browser, scenes) {
  const report = scenes.json('motor.json');
  const runs = report.properties.map((p, i) => [p, i + 1]).filter(
      ([p]) => p.trace && p.trace.steps.length > 1);
  assert.ok(runs.length >= 2, 'the example has too few runs');
  await open(browser, scenes.url('motor.html'), async page => {
    for (const [property, number] of runs) {
      const id = `#file-1-obligation-${number}`;
      await page.locator(id).evaluate(details => { details.open = true; });
      const run = page.locator(`${id} .run`);
      await run.scrollIntoViewIfNeeded();
      await run.locator('output').waitFor();
      const scans = property.trace.steps.map(step => step.scan);
      const last = scans[scans.length - 1];
      check_scan(await look(page, id), property.trace, last);
      await run.focus();
      await page.keyboard.press('Home');
      let seen = await look(page, id);
      let cursor = -1;
      let steps = 0;
      while (true) {
        check_scan(seen, property.trace, seen.scan);
        assert.ok(seen.cursor > cursor, 'the diagram has no cursor');
        cursor = seen.cursor;
        if (seen.scan === last) break;
        await page.keyboard.press('ArrowRight');
        const next = await look(page, id);
        assert.ok(next.scan > seen.scan);
        seen = next;
        ++steps;
      }
      assert.ok(steps > 0);
      await page.keyboard.press('ArrowRight');
      assert.strictEqual((await look(page, id)).scan, last);
      await page.keyboard.press('ArrowLeft');
      assert.ok((await look(page, id)).scan < last);
      await page.keyboard.press('End');
      assert.strictEqual((await look(page, id)).scan, last);
    }
  });
}

/** The run of the first obligation that has one, and its scans. */
function first_run(scenes) {
  const properties = scenes.json('motor.json').properties;
  const index = properties.findIndex(
      p => p.trace && p.trace.steps.length > 1);
  return {id: `#file-1-obligation-${index + 1}`,
          scans: properties[index].trace.steps.map(step => step.scan)};
}

async function buttons_and_slider_step(browser, scenes) {
  const {id, scans} = first_run(scenes);
  await open(browser, scenes.url('motor.html', id), async page => {
    const at = async () => (await look(page, id)).scan;
    const press = name => page.locator(id).getByRole('button', {name}).click();
    const last = scans[scans.length - 1];
    assert.strictEqual(await at(), last);
    await press('First');
    const first = await at();
    assert.ok(first < last);
    await press('Next');
    assert.ok(await at() > first);
    await press('Back');
    assert.strictEqual(await at(), first);
    await press('Last');
    assert.strictEqual(await at(), last);
    await page.locator(`${id} input`).focus();
    await page.keyboard.press('Home');
    assert.strictEqual(await at(), first);
    await page.locator(`${id} tbody tr`).last().click();
    assert.strictEqual(await at(), last);
    await page.locator(`${id} .plot`).click({position: {x: 15, y: 30}});
    assert.strictEqual(await at(), first);
  });
}

async function play_runs_to_the_end(browser, scenes) {
  const {id, scans} = first_run(scenes);
  const url = scenes.url('motor.html');
  await open(browser, url, async page => {
    await page.clock.install({time: 0});
    await page.goto(url + `${id}&scan=1`);
    await page.reload();
    // From here on only runFor() lets time pass.
    await page.clock.pauseAt(3600_000);
    const at = async () => (await look(page, id)).scan;
    const button = page.locator(id).getByRole('button', {name: /Play|Pause/});
    const first = await at();
    await button.click();
    assert.strictEqual(await button.textContent(), 'Pause');
    await page.clock.runFor(750);
    assert.ok(await at() > first);
    await page.clock.runFor(700 * scans.length);
    assert.strictEqual(await at(), scans[scans.length - 1]);
    assert.strictEqual(await button.textContent(), 'Play');
    await page.locator(`${id} .run`).focus();
    await page.keyboard.press(' ');
    assert.strictEqual(await button.textContent(), 'Pause');
    assert.strictEqual(await at(), first);
    await page.keyboard.press(' ');
    await page.clock.runFor(5000);
    assert.strictEqual(await at(), first);
  });
}

async function a_link_names_a_scan(browser, scenes) {
  const {id, scans} = first_run(scenes);
  const url = scenes.url('motor.html', `${id}&scan=${scans[0]}`);
  await open(browser, url, async page => {
    assert.strictEqual((await look(page, id)).scan, scans[0]);
    await page.keyboard.press('End');
    const link = page.locator(`${id} .controls a`);
    const last = scans[scans.length - 1];
    assert.strictEqual(await link.getAttribute('href'), `${id}&scan=${last}`);
    await link.click();
    await page.evaluate(hash => { location.hash = hash; },
                        `${id}&scan=${scans[0]}`);
    await page.waitForFunction(
        ([at, scan]) => document.querySelector(`${at} output`)
                            .textContent.startsWith(`Scan ${scan},`),
        [id, scans[0]]);
  });
}

async function equivalence_has_both_sides(browser, scenes) {
  await open(browser, scenes.url('equiv.html', kStop), async page => {
    const run = page.locator(`${kStop} .run`);
    const sides = run.locator('.rungs > div');
    assert.strictEqual(await sides.count(), 2);
    const [a, b] = [await sides.nth(0).boundingBox(),
                    await sides.nth(1).boundingBox()];
    assert.ok(b.x >= a.x + a.width && b.y === a.y, 'not beside each other');
    const differing = await run.locator('td.differs').allTextContents();
    assert.strictEqual(differing.length, 2);
    assert.notStrictEqual(differing[0], differing[1]);
    assert.match(await run.locator('td.remark.bad').textContent(),
                 /^different here/);
  }, {viewport: {width: 1400, height: 900}});
}

async function hostile_names_run_nothing(browser, scenes) {
  await open(browser, scenes.url('hostile.html', kStop), async page => {
    assert.strictEqual(await page.locator('img').count(), 0);
    assert.match(await page.locator('h2#file-1').textContent(),
                 /script><img src=x/);
    await page.locator(`${kStop} output`).waitFor();
  });
}

async function nothing_is_in_the_way_of_any_reader(browser, scenes) {
  for (const name of ['motor.html', 'equiv.html', 'hostile.html']) {
    for (const colorScheme of ['light', 'dark']) {
      await open(browser, scenes.url(name, kStop), async page => {
        await page.locator('details').evaluateAll(
            all => all.forEach(details => { details.open = true; }));
        await page.locator(`${kStop} output`).waitFor();
        await page.addScriptTag({path: axe});
        const found = await page.evaluate(() => axe.run());
        const said = found.violations.map(
            v => `${v.id}: ${v.help}: ${v.nodes[0].html}`);
        assert.deepStrictEqual(said, [], `${name}, ${colorScheme}`);
        assert.ok(found.passes.length > 20);
      }, {colorScheme, bypassCSP: true});
    }
  }
}

async function the_colours_follow_the_reader(browser, scenes) {
  const of = colorScheme => open(
      browser, scenes.url('motor.html'),
      page => page.evaluate(() => [
        getComputedStyle(document.body).backgroundColor,
        getComputedStyle(document.querySelector('.ladder path')).stroke]),
      {colorScheme});
  const [light, dark] = [await of('light'), await of('dark')];
  assert.notStrictEqual(light[0], dark[0]);
  assert.notStrictEqual(light[1], dark[1]);
}

async function it_prints_a_run_a_page(browser, scenes) {
  await open(browser, scenes.url('motor.html'), async page => {
    await page.emulateMedia({media: 'print'});
    const style = (selector, name) => page.locator(selector).first().evaluate(
        (element, key) => getComputedStyle(element)[key], name);
    assert.strictEqual(
        await style('details.violated.has-run', 'breakBefore'), 'page');
    assert.strictEqual(await style('.run > .scroll', 'overflowX'), 'visible');
    const pdf = (await page.pdf()).toString('latin1');
    assert.ok(pdf.match(/\/Type\s*\/Page\b/g).length > 1);
    await page.locator(`${kStop} output`).waitFor();
    assert.strictEqual(await style('.controls button', 'display'), 'none');
  });
}

async function it_reads_without_script(browser, scenes) {
  await open(browser, scenes.url('motor.html'), async page => {
    for (const part of ['table.scans', 'figure svg.ladder path.on']) {
      const found = page.locator(`${kStop} ${part}`).first();
      assert.ok(await found.isVisible(), part);
    }
    assert.strictEqual(await page.locator('.controls').count(), 0);
    assert.strictEqual(await page.locator('.program svg').count(), 4);
  }, {javaScriptEnabled: false});
}

async function motion_only_for_those_who_want_it(browser, scenes) {
  const of = reducedMotion => open(
      browser, scenes.url('motor.html', kStop),
      page => page.locator(`${kStop} .cursor`).evaluate(
          rect => getComputedStyle(rect).transitionDuration),
      {reducedMotion});
  assert.match(await of('no-preference'), /0\.15s/);
  assert.strictEqual(await of('reduce'), '0s');
}

async function it_fits_a_narrow_screen(browser, scenes) {
  await open(browser, scenes.url('motor.html', kStop), async page => {
    await page.locator(`${kStop} output`).waitFor();
    const [wide, seen] = await page.evaluate(
        () => [document.documentElement.scrollWidth, innerWidth]);
    assert.ok(wide <= seen, `${wide} of ${seen} pixels`);
  }, {viewport: {width: 360, height: 700}});
}

async function five_hundred_properties_are_light(browser, scenes) {
  const bytes = fs.statSync(scenes.file('many.html')).size;
  assert.ok(bytes < 3e6, `${bytes} bytes`);
  await open(browser, scenes.url('many.html'), async page => {
    const ms = await page.evaluate(() => {
      const [entry] = performance.getEntriesByType('navigation');
      return Math.round(entry.duration);
    });
    console.log(`        ${bytes} bytes, read in ${ms} ms`);
    assert.strictEqual(await page.locator('details[id]').count() >= 500, true);
    const wrong = await page.locator('details.violated.has-run').count();
    assert.strictEqual(wrong, 125);
    // Only what is in sight is built.
    assert.ok(await page.locator('.controls').count() < 20);
    const last = page.locator('details.violated.has-run').last();
    await last.locator('summary').click();
    await last.scrollIntoViewIfNeeded();
    await last.locator('output').waitFor();
    assert.ok(await last.locator('svg.ladder path.on').count() > 0);
    assert.match(await last.locator('.why').textContent(), /^Power reaches /);
    // On paper all of them are there.
    await page.evaluate(() => { dispatchEvent(new Event('beforeprint')); });
    assert.strictEqual(await page.locator('details[open] .controls').count(),
                       wrong);
  });
}

/** The values of a lane at each of its characters. */
function lane_values(lane) {
  const data = [...(lane.data || [])];
  let value = null;
  return [...lane.wave].map(c => {
    if (c === '0' || c === '1') value = Number(c);
    if (c === '=') value = Number(data.shift());
    return value;
  });
}

async function wavejson_is_what_wavedrom_draws(browser, scenes) {
  const properties = scenes.json('motor.json').properties.filter(
      p => p.trace && p.trace.steps.length > 0);
  const written = fs.readdirSync(scenes.file('traces'));
  assert.strictEqual(written.length, 3 * properties.length);
  for (const {name, trace} of properties) {
    const wave = scenes.json(`traces/${name}.json`);
    const svg = wavedrom.onml.stringify(wavedrom.renderAny(0, wave, skins));
    const lanes = wave.signal.flatMap(
        part => Array.isArray(part) ? part.slice(1) : [part]);
    const drawn = lanes.filter(lane => svg.includes(`>${lane.name}</`));
    assert.strictEqual(drawn.length, lanes.length);
    assert.strictEqual(lanes.length, trace.signals.length + 1);
    // A character may stand for several steps of the trace.
    const [time, ...signals] = lanes;
    assert.ok(time.data.length > 0 && time.data.length <= trace.steps.length);
    for (const lane of signals) {
      assert.ok(/^[01=]/.test(lane.wave));
      const last = trace.steps[trace.steps.length - 1].values[lane.name];
      assert.strictEqual(lane_values(lane).pop(), last, lane.name);
      const seen = new Set(lane_values(lane));
      for (const step of trace.steps) {
        assert.ok(seen.has(step.values[lane.name]), lane.name);
      }
    }
  }
}

async function a_stimulus_runs_into_the_violation(browser, scenes) {
  const properties = scenes.json('motor.json').properties.filter(
      p => p.trace && p.trace.steps.length > 0);
  for (const {name, trace} of properties) {
    const done = scenes.write({}, 0, 'run', 'motor.rung', '--stimulus',
                              `traces/${name}.csv`, '--format', 'json');
    const run = JSON.parse(done.stdout).trace.steps;
    const [end, wanted] = [run, trace.steps].map(all => all[all.length - 1]);
    assert.strictEqual(end.scan, wanted.scan);
    assert.deepStrictEqual(end.values, wanted.values);
  }
}

async function a_run_can_be_saved(browser, scenes) {
  const {id, scans} = first_run(scenes);
  await open(browser, scenes.url('motor.html', id), async page => {
    const saved = async name => {
      const [download] = await Promise.all([
        page.waitForEvent('download'),
        page.locator(id).getByRole('button', {name, exact: true}).click()]);
      return JSON.parse(fs.readFileSync(await download.path(), 'utf8'));
    };
    const json = await saved('Save JSON');
    assert.strictEqual(json.scan.pop(), scans[scans.length - 1]);
    const wave = await saved('Save WaveJSON');
    assert.strictEqual(wave.signal.length, json.signals.length + 1);
    wavedrom.renderAny(0, wave, skins);
    for (const signal of json.signals) {
      const lane = wave.signal.find(one => one.name === signal.name);
      assert.deepStrictEqual(lane_values(lane), signal.values);
    }
  });
}

module.exports = {
  a_run_can_be_saved,
  wavejson_is_what_wavedrom_draws, a_stimulus_runs_into_the_violation,
  keys_step, buttons_and_slider_step, play_runs_to_the_end,
  a_link_names_a_scan, equivalence_has_both_sides, hostile_names_run_nothing,
  nothing_is_in_the_way_of_any_reader, the_colours_follow_the_reader,
  it_prints_a_run_a_page, it_reads_without_script,
  motion_only_for_those_who_want_it, it_fits_a_narrow_screen,
  five_hundred_properties_are_light};
