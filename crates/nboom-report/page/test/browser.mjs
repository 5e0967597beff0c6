// Opens reports in a browser as a person would:
//
//     node test/browser.mjs FOLDER
//
// FOLDER has the runs that .ci/report makes. Chromium is taken from the path, or from CHROMIUM.

import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { chromium } from 'playwright-core';

const folder = resolve(process.argv[2]);
const executablePath = process.env.CHROMIUM ?? ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync);
const browser = await chromium.launch({
  executablePath, args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});

/** A table of a run, rows by name. */
function table(run, file) {
  const [head, ...rows] = readFileSync(join(folder, run, file), 'utf8').trim().split('\n').map((line) => line.split(','));
  return rows.map((row) => Object.fromEntries(row.map((value, i) => [head[i], value])));
}

/** A page that was opened from its file, and fails on any error or request. */
async function open(name, { width = 1280, height = 900, colorScheme = 'light' } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, colorScheme, acceptDownloads: true });
  const page = await context.newPage();
  // What is written on canvases, and where it begins.
  await page.addInitScript(() => {
    const write = CanvasRenderingContext2D.prototype.fillText;
    window.written = [];
    window.below = [];
    CanvasRenderingContext2D.prototype.fillText = function fillText(text, x, ...rest) {
      if (this.textAlign === 'center') window.below.push(text);
      if (this.textAlign === 'right') window.written.push({ text, from: x - this.measureText(text).width });
      return write.call(this, text, x, ...rest);
    };
  });
  const wrong = [];
  page.on('console', (message) => { if (['error', 'warning'].includes(message.type())) wrong.push(message.text()); });
  page.on('pageerror', (error) => wrong.push(error.stack));
  page.on('dialog', (dialog) => { wrong.push(`dialog: ${dialog.message()}`); dialog.dismiss(); });
  page.on('request', (request) => { if (!/^(file|data|blob):/.test(request.url())) wrong.push(`request: ${request.url()}`); });
  const path = join(folder, name.endsWith('.html') ? name : `${name}/report.html`);
  await page.goto(`file://${path}`);
  await page.waitForSelector('html[data-ready]', { timeout: 60_000 });
  page.done = async () => {
    // What SwiftShader says about itself is not the page's.
    const own = wrong.filter((text) => !/GPU stall|swiftshader|WebGL.*fallback/i.test(text));
    assert.deepEqual(own, [], `${name} is quiet`);
    await context.close();
  };
  return page;
}

const angles = (page) => page.$$eval('.angle', (found) => Object.fromEntries(found.map((one) => [one.dataset.joint, Number(one.dataset.radians)])));
const clock = (page) => page.$eval('.clock', (found) => found.textContent);
const setTime = (page, share) => page.$eval('#time-0', (slider, value) => { slider.value = value; slider.dispatchEvent(new Event('input')); }, share);

/** Red, green and blue of the picture on a coarse grid, row by row. */
const pixels = (page, columns, rows) => page.$eval('.picture canvas', (canvas, [across, down]) => {
  const small = document.createElement('canvas');
  [small.width, small.height] = [across, down];
  const flat = small.getContext('2d');
  flat.drawImage(canvas, 0, 0, across, down);
  return [...flat.getImageData(0, 0, across, down).data];
}, [columns, rows]);

const checks = {
  async 'the slider moves the panels, and nothing else'() {
    const page = await open('wing');
    for (const layer of ['axes', 'joints', 'centre', 'momentum']) await page.click(`[data-layer=${layer}]`);
    const [columns, rows] = [60, 40];
    await setTime(page, 0);
    const stowed = await pixels(page, columns, rows);
    await setTime(page, 1);
    const deployed = await pixels(page, columns, rows);
    const covered = (found, column) => {
      let count = 0;
      for (let row = 0; row < rows; row++) count += found[4 * (row * columns + column) + 3] > 64 ? 1 : 0;
      return count;
    };
    const where = (found) => Array.from({ length: columns }, (_, column) => column).filter((column) => covered(found, column) > 0);
    const width = (found) => Math.max(...where(found)) - Math.min(...where(found));
    // Stowed, all stands in the middle; deployed, the wings reach far to both sides of it.
    assert.ok(width(deployed) > 1.6 * width(stowed), `${width(stowed)} columns stowed, ${width(deployed)} deployed`);
    assert.ok(Math.min(...where(deployed)) < Math.min(...where(stowed)) && Math.max(...where(deployed)) > Math.max(...where(stowed)));
    // A corner of the picture has nothing in it at any time.
    assert.deepEqual(deployed.slice(0, 4), stowed.slice(0, 4));
    await setTime(page, 0);
    assert.deepEqual(await pixels(page, columns, rows), stowed, 'and back');
    await page.done();
  },

  async 'events are listed and reached by keys, with the angles of the tables'() {
    for (const run of ['wing', '1970', 'mast']) {
      const page = await open(run);
      const events = table(run, 'events.csv');
      assert.equal(await page.locator('tr.event').count(), Math.min(events.length, 40));
      // Impulses of slides say their unit in the cell.
      const [heading, ...impulses] = await page.$$eval('table.events tr', (rows) => rows.map((row) => row.cells[3]?.textContent ?? ''));
      assert.ok(!heading.includes(';'), heading);
      assert.equal(impulses.some((text) => text.endsWith(' N s')), run === 'mast', `${run}: ${impulses}`);
      const [states, instants] = [table(run, 'states.csv'), table(run, 'instants.csv')];
      const times = [...new Set(events.map(({ t }) => Number(t)))];
      const first = Number(states[0].t);
      let compared = 0;
      for (const time of times.filter((t) => t > first)) {
        await page.keyboard.press('n');
        const shown = await page.$$eval('tr.event.now', (rows) => rows.map((row) => Number(row.dataset.t)));
        assert.ok(shown.length > 0 && shown.every((t) => t === time), `${run}: n leads to ${time}`);
        const found = await angles(page);
        const of = (rows) => rows.findLast(({ t }) => Number(t) === time);
        for (const row of [of(states), of(instants)].filter(Boolean)) {
          for (const [joint, angle] of Object.entries(found)) {
            assert.equal(angle, Number(row[`beta_${joint}`]), `${run}: ${joint} at ${time}`);
            compared += 1;
          }
        }
      }
      assert.ok(compared >= Object.keys(await angles(page)).length * times.length / 2, `${run}: ${compared} angles compared`);
      await page.keyboard.press('p');
      assert.deepEqual(await page.$$eval('tr.event.now', (rows) => [...new Set(rows.map((row) => Number(row.dataset.t)))]), [times.at(-2)]);
      await page.done();
    }
  },

  async 'an event at an output time shows the row of states.csv'() {
    const page = await open('wing-by-seconds');
    const states = table('wing-by-seconds', 'states.csv');
    const event = table('wing-by-seconds', 'events.csv').find(({ t }) => states.some((row) => row.t === t));
    assert.equal(event.kind, 'release');
    await page.locator(`tr.event[data-t="${Number(event.t)}"]`).first().click();
    const row = states.find(({ t }) => t === event.t);
    for (const [joint, angle] of Object.entries(await angles(page))) assert.equal(angle, Number(row[`beta_${joint}`]));
    await page.done();
  },

  async 'keys play, step, change the view and the colours'() {
    const page = await open('gimbal');
    const start = await clock(page);
    await page.keyboard.press('ArrowRight');
    const stepped = await clock(page);
    assert.notEqual(stepped, start);
    await page.keyboard.press('ArrowLeft');
    assert.equal(await clock(page), start);
    await page.keyboard.press(' ');
    await page.waitForFunction((text) => document.querySelector('.clock').textContent !== text, start);
    await page.keyboard.press(' ');
    const paused = await clock(page);
    await page.waitForTimeout(200);
    assert.equal(await clock(page), paused, 'it stands still');
    await page.keyboard.press('End');
    const inertial = await pixels(page, 80, 50);
    await page.keyboard.press('v');
    assert.match(await page.textContent('#view'), /riding/);
    assert.notDeepEqual(await pixels(page, 80, 50), inertial);
    const background = () => page.$eval('body', (body) => getComputedStyle(body).backgroundColor);
    const light = await background();
    await page.keyboard.press('t');
    assert.notEqual(await background(), light);
    await page.keyboard.press('Home');
    assert.equal(await clock(page), start);
    await page.done();
  },

  async 'it fits a phone, in light and dark'() {
    for (const colorScheme of ['light', 'dark']) {
      for (const run of ['1970', 'twenty', 'comparison.html']) {
        const page = await open(run, { width: 390, height: 844, colorScheme });
        const [content, screen] = await page.evaluate(() => [document.scrollingElement.scrollWidth, innerWidth]);
        assert.ok(content <= screen, `${run}: ${content} pixels on a screen of ${screen}`);
        const sum = await page.$eval('body', (body) => getComputedStyle(body).backgroundColor.match(/\d+/g).slice(0, 3).reduce((a, b) => a + Number(b), 0));
        assert.equal(sum < 380, colorScheme === 'dark');
        await page.done();
      }
    }
  },

  async 'twenty segments with stresses are there within two seconds'() {
    const page = await open('twenty');
    const picture = Number(await page.$eval('html', (html) => html.dataset.picture));
    console.log(`    first picture after ${picture} ms, ${Math.round(readFileSync(join(folder, 'twenty/report.html')).length / 1000)} kB`);
    assert.ok(picture < 2000, `${picture} ms`);
    assert.ok(await page.locator('[data-layer=stress]').count());
    await page.keyboard.press('End');
    const coloured = await pixels(page, 120, 80);
    await page.click('[data-layer=stress]');
    assert.notDeepEqual(await pixels(page, 120, 80), coloured);
    await page.done();
  },

  async 'texts of a scene stay texts'() {
    const page = await open('hostile');
    assert.equal(await page.title(), `<script>alert('1')<!-- & "quoted" \ufffd`);
    assert.equal(await page.locator('img, b b, script').count(), 2, 'data and program');
    const text = await page.textContent('body');
    assert.ok(text.includes('<img src=x onerror=alert(1)>'));
    assert.ok(!/[\u202a-\u202e\u2066-\u2069]/.test(await page.evaluate(() => document.body.innerText)), 'nothing turns its direction');
    await page.done();
  },

  async 'the data of curves can be saved'() {
    const page = await open('wing');
    const [download] = await Promise.all([page.waitForEvent('download'), page.locator('.curve .save').first().click()]);
    const saved = readFileSync(await download.path(), 'utf8').trim().split('\n').map((line) => line.split(','));
    const [states, instants] = [table('wing', 'states.csv'), table('wing', 'instants.csv')];
    assert.equal(saved.length - 1, states.length + instants.length);
    const last = states.at(-1);
    assert.equal(Number(saved.at(-1)[0]), Number(last.t));
    assert.ok(Math.abs(Number(saved.at(-1)[1]) - (Number(last.beta_1_1) * 180) / Math.PI) < 1e-12);
    await page.done();
  },

  async 'a kick-off spring that lets go pushes until then, and not after'() {
    const page = await open('1970');
    const [download] = await Promise.all([page.waitForEvent('download'), page.locator('[data-title="Kick-off forces"] .save').click()]);
    const [head, ...saved] = readFileSync(await download.path(), 'utf8').trim().split('\n').map((line) => line.match(/"[^"]*"|[^,]+/g));
    const ends = table('1970', 'events.csv').filter(({ kind }) => kind === 'kick_off_disengage');
    assert.ok(ends.length > 0);
    for (const { t, appendage, segment } of ends) {
      const column = head.findIndex((name) => name.includes(`${appendage},${segment}`));
      const forces = saved.filter(([time]) => Number(time) === Number(t)).map((row) => Number(row[column]));
      assert.ok(forces[0] !== 0 && forces.at(-1) === 0, `${appendage},${segment}: ${forces} at ${t}`);
    }
    await page.done();
  },

  async 'hinges with the largest moments come first'() {
    const page = await open('1970');
    const moments = table('1970', 'hinge_load_envelope.csv').filter(({ quantity }) => quantity === 'moment');
    moments.sort((a, b) => b.magnitude - a.magnitude);
    const found = await page.$$eval('h3', (titles) => {
      const loads = titles.find((title) => title.textContent === 'Largest hinge loads').nextElementSibling;
      return [...loads.querySelectorAll('tbody tr')].map((row) => row.firstChild.textContent);
    });
    assert.deepEqual(found, moments.map(({ appendage, segment }) => `segment ${appendage},${segment}`));
    await page.done();
  },

  async 'each joint says how fast its latch closed, or how near it came'() {
    for (const run of ['1970', 'wing', 'mast', 'gimbal']) {
      const page = await open(run);
      const { hinges } = JSON.parse(readFileSync(join(folder, run, 'summary.json'), 'utf8')).verdict;
      const told = await page.$$eval('.hinges li', (items) => items.map((item) => item.querySelector('.latch')?.textContent ?? null));
      const expected = hinges.map(({ closing_rate: rate, miss }) =>
        rate !== null ? 'its latch closed at ' : miss !== null ? 'nearest to its latch at ' : null);
      assert.deepEqual(told.map((text) => text && text.slice(0, text.indexOf(' at ') + 4)), expected, run);
      await page.done();
    }
  },

  async 'times have the digits that tell moments of the run apart, and the verdict says by what loads are judged'() {
    const page = await open('epoch');
    const events = table('epoch', 'events.csv').map(({ t }) => Number(t));
    const told = await page.$$eval('tr.event td:first-child', (cells) => cells.map((cell) => Number(cell.textContent)));
    assert.equal(told.length, events.length);
    told.forEach((time, i) => assert.ok(Math.abs(time - events[i]) <= 1e-3, `${time}, ${events[i]}`));
    await page.keyboard.press('n');
    const shown = await page.$eval('.clock', (clock) => clock.textContent);
    assert.ok(shown.startsWith('t = 2592001.25 '), shown);
    const verdict = await page.$eval('#verdict', (section) => section.textContent);
    assert.ok(verdict.includes('judged by dynamic amplification of pulses 1.5'), verdict);
    await page.done();
  },

  async 'it prints'() {
    const page = await open('1970');
    assert.ok((await page.pdf({ format: 'A4' })).length > 50_000);
    await page.done();
  },

  async 'no label of an axis is cut'() {
    for (const name of ['1970', 'comparison.html', 'wing']) {
      const page = await open(name);
      const written = await page.evaluate(() => window.written);
      assert.ok(written.length > 20);
      assert.deepEqual(written.filter(({ from }) => from < 0), [], name);
      await page.done();
    }
  },

  async 'a main body that is held stands still'() {
    const page = await open('rig');
    for (const layer of ['axes', 'joints', 'centre', 'momentum']) await page.click(`[data-layer=${layer}]`);
    const [columns, rows] = [120, 80];
    const leftmost = async (time) => {
      await setTime(page, time);
      const found = await pixels(page, columns, rows);
      return Array.from({ length: columns }, (_, column) => column)
        .find((column) => Array.from({ length: rows }, (_, row) => found[4 * (row * columns + column) + 3] > 64).some(Boolean));
    };
    // The panel swings to the right, the box is left of it.
    assert.equal(await leftmost(1), await leftmost(0));
    await page.done();
  },

  async 'rotors and rigs have their curves'() {
    const page = await open('wheels');
    const saved = async (title) => {
      const [download] = await Promise.all([page.waitForEvent('download'), page.locator(`[data-title="${title}"] .save`).click()]);
      return readFileSync(await download.path(), 'utf8').trim().split('\n').map((line) => line.match(/"[^"]*"|[^,]+/g));
    };
    const [head, ...speeds] = await saved('Speeds of rotors');
    assert.deepEqual(head, ['t [s]', '"rotor 1, main body [°/s]"', '"rotor 2, boom [°/s]"']);
    const degrees = (radians) => (radians * 180) / Math.PI;
    // The corners of the table lie between output times.
    for (const [time, first] of [[1.1, 0], [1.3, 300], [4, 300]]) {
      const row = speeds.findLast(([t]) => Number(t) === time).map(Number);
      assert.ok(Math.abs(row[1] - degrees(first)) < 1e-9 && Math.abs(row[2] - degrees(20)) < 1e-9, `${row}`);
    }
    const output = table('wheels', 'output.csv');
    const column = (rows, place) => rows.map((row) => Number(row[place]));
    for (const [title, names] of [['Torques of motors', ['motor_torque_1', 'motor_torque_2']], ['Force of the rig', ['reaction_force_x', 'reaction_force_y', 'reaction_force_z']]]) {
      const [, ...rows] = await saved(title);
      names.forEach((name, i) => assert.deepEqual(column(rows, i + 1), output.map((row) => Number(row[name])), name));
    }
    const [, ...velocities] = await saved('Velocity of the main body, inertial axes');
    assert.equal(Number(velocities.at(-1)[3]), Number(table('wheels', 'states.csv').at(-1).v_z));
    for (const title of ['Torques of motors', 'Force of the rig']) {
      assert.match(await page.locator(`[data-title="${title}"]`).innerText(), /At output times; peaks between them are not seen/);
    }
    assert.match(await page.locator('body').innerText(), /Nutation of [xyz]\b/);
    await page.done();
  },

  async 'a run of no length stands in the middle of its axes'() {
    const page = await open('moment');
    const times = (await page.evaluate(() => window.below)).map((text) => Number(text.replace('\u2212', '-'))).filter(Number.isFinite);
    assert.ok(times.length > 2 && times.every((time) => Math.abs(time) <= 1), `${times}`);
    assert.equal(await page.locator('.curve').count() > 3, true);
    await page.keyboard.press(' ');
    assert.equal(await clock(page), 't = 0 s');
    await page.done();
  },

  async 'runs are compared on the same axes'() {
    const page = await open('comparison.html');
    assert.equal(await page.locator('table.comparison thead th').count(), 3);
    const legends = await page.$$eval('.curve', (figures) => figures.map((figure) => figure.querySelectorAll('.u-legend .u-series').length));
    assert.ok(legends.length > 5 && legends.filter((count) => count === 3).length > 4, `${legends}`);
    const loads = page.locator('.curve[data-title^="Hinge moments"]');
    const [download] = await Promise.all([page.waitForEvent('download'), loads.locator('.save').click()]);
    const saved = readFileSync(await download.path(), 'utf8');
    for (const run of ['1970', 'as-1970']) {
      const peak = table(run, 'hinge_load_envelope.csv').find(({ quantity }) => quantity === 'moment');
      assert.ok(saved.includes(String(Number(peak.magnitude))), `${run}: the largest moment is drawn`);
    }
    assert.match(await loads.locator('.note').textContent(), /^Dots: the largest/);
    await page.done();
  },

  async 'what is wrong with results stands in the open, beside other runs too'() {
    const troubles = (run) => JSON.parse(readFileSync(join(folder, run, 'summary.json'), 'utf8')).troubles;
    assert.ok(troubles('as-1970').some((text) => text.startsWith('wrong on purpose, as in 1970: ')));
    const page = await open('as-1970');
    assert.deepEqual(await page.$$eval('#verdict > .problem', (found) => found.map(({ textContent }) => textContent)), troubles('as-1970'));
    assert.ok((await page.$$eval('.warnings li', (found) => found.map(({ textContent }) => textContent))).every((text) => !troubles('as-1970').includes(text)));
    await page.done();
    const beside = await open('comparison.html');
    const found = await beside.$$eval('#verdict .problem', (all) => all.map((one) => [one.parentElement.firstChild.textContent, one.textContent]));
    assert.deepEqual(found.map(([run, text]) => [run.split('/').at(-1), text]), ['1970', 'as-1970'].flatMap((run) => troubles(run).map((text) => [run, text])));
    await beside.done();
  },
};

let failed = 0;
for (const [name, check] of Object.entries(checks)) {
  const started = performance.now();
  try {
    await check();
    console.log(`ok  ${name} (${Math.round(performance.now() - started)} ms)`);
  } catch (error) {
    failed += 1;
    console.log(`FAILED  ${name}\n${error.stack}`);
  }
}
await browser.close();
process.exit(failed === 0 ? 0 : 1);
