// Opens pages of sweeps in a browser as a person would:
//
//     node test/sweep.mjs PAGE...
//
// Chromium is taken from the path, or from CHROMIUM.

import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { resolve } from 'node:path';
import { chromium } from 'playwright-core';

const executablePath = process.env.CHROMIUM ?? ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync);
const browser = await chromium.launch({ executablePath, args: ['--no-sandbox'] });

/** A page that was opened from its file, and fails on any error or request. */
async function open(path, { width = 1280, height = 900, colorScheme = 'light' } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, colorScheme });
  const page = await context.newPage();
  const wrong = [];
  page.on('console', (message) => { if (['error', 'warning'].includes(message.type())) wrong.push(message.text()); });
  page.on('pageerror', (error) => wrong.push(error.stack));
  page.on('dialog', (dialog) => { wrong.push(`dialog: ${dialog.message()}`); dialog.dismiss(); });
  page.on('request', (request) => { if (!request.url().startsWith('file:')) wrong.push(`request: ${request.url()}`); });
  await page.goto(`file://${path}`);
  await page.waitForSelector('html[data-ready]', { timeout: 30_000 });
  page.data = JSON.parse(await page.textContent('#data'));
  page.done = async () => {
    assert.deepEqual(wrong, [], `${path} is quiet`);
    await context.close();
  };
  return page;
}

/** A count as pages tell it. */
const whole = (count) => count.toLocaleString('en');

const checks = {
  async 'each result has its histogram and its percentiles'(path) {
    const page = await open(path);
    const { columns } = page.data.summary;
    for (const [i, { name, histogram }] of columns.entries()) {
      if (!histogram) continue;
      const figure = page.locator(`[data-column="${i}"]`);
      assert.equal(await figure.locator('rect.bar').count(), histogram.counts.length, name);
      assert.equal(await figure.locator('tbody tr').count(), 7, name);
      const width = await figure.locator('rect.bar').first().getAttribute('width');
      assert.ok(Number(width) > 2, `bars of ${name} are seen`);
    }
    assert.ok(columns.some((column) => column.histogram), 'a sweep in which something ran');
    await page.done();
  },

  async 'other axes are another scatter plot, with all of its points'(path) {
    const page = await open(path);
    const { columns, points } = page.data.summary;
    const circles = () => page.$$eval('.scatter circle', (found) => found.map((one) => [Number(one.getAttribute('cx')), Number(one.getAttribute('cy'))]));
    const varies = columns.map((_, i) => i).filter((i) => new Set(points.values[i].filter((value) => value !== null)).size > 1);
    const [a, b] = [varies[0], varies.at(-1)];
    await page.selectOption('#scatter-x', String(a));
    await page.selectOption('#scatter-y', String(b));
    const before = await circles();
    const rows = points.cases.map((_, i) => i).filter((i) => points.values[a][i] !== null && points.values[b][i] !== null);
    assert.equal(before.length, rows.length);
    const told = await page.locator('#scatter > .note').textContent();
    assert.match(told, new RegExp(`^${whole(rows.length)} of `), 'it says how many points there are');
    // Places grow with numbers, upwards.
    const numbers = (column) => rows.map((i) => points.values[column][i]);
    const follows = (places, values) => places.every((place, i) => i === 0 || Math.abs(place - places[i - 1]) < 0.11 || (place > places[i - 1]) === (values[i] > values[i - 1]));
    assert.ok(follows(before.map(([x]) => x), numbers(a)) && follows(before.map(([, y]) => -y), numbers(b)));
    await page.selectOption('#scatter-x', String(b));
    await page.selectOption('#scatter-y', String(a));
    const after = await circles();
    assert.ok(follows(after.map(([x]) => x), numbers(b)) && follows(after.map(([, y]) => -y), numbers(a)));
    assert.notDeepEqual(after, before);
    await page.done();
  },

  async 'labels of axes are the numbers at their places'(path) {
    const page = await open(path);
    const axes = await page.$$eval('svg', (pictures) => pictures.flatMap((svg) => ['middle', 'end'].map((anchor) => {
      const texts = [...svg.querySelectorAll(`text[text-anchor="${anchor}"]`)].filter((text) => /^[\u2212\d]/.test(text.textContent));
      return texts.map((text) => [text.textContent, Number(text.getAttribute(anchor === 'middle' ? 'x' : 'y'))]);
    })));
    const superscripts = '\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079\u207b';
    const number = (text) => {
      const [mantissa, power] = text.replaceAll('\u2212', '-').replace(/[,%\u202f]/g, '').split('\u00b710');
      return Number(mantissa) * 10 ** Number([...(power ?? '')].map((c) => '0123456789-'[superscripts.indexOf(c)]).join(''));
    };
    assert.ok(axes.some((labels) => labels.length > 2));
    for (const labels of axes.filter((found) => found.length > 1)) {
      const [[first, from], [last, to]] = [labels[0], labels.at(-1)];
      for (const [text, place] of labels) {
        const share = (number(text) - number(first)) / (number(last) - number(first));
        assert.ok(Math.abs(share - (place - from) / (to - from)) < 0.01, `${text} of ${labels.map(([one]) => one)}`);
      }
    }
    await page.done();
  },

  async 'it warns of cases that are not to be trusted, with the first of them'(path) {
    const page = await open(path);
    const { runaway, first_runaway: firstRunaway, poor, first_poor: firstPoor, doubtful, first_doubtful: firstDoubtful } = page.data.summary.counts;
    const warnings = await page.$$eval('#account .warning', (found) => found.map((one) => one.textContent));
    for (const [count, first, words] of [[runaway, firstRunaway, /runs away/], [poor, firstPoor, /poor conservation/], [doubtful, firstDoubtful, /whether a hinge locks/]]) {
      const found = warnings.filter((text) => words.test(text));
      assert.equal(found.length, count > 0 ? 1 : 0);
      if (count > 0) assert.match(found[0], new RegExp(`\\b${whole(count)}\\b.* case ${first}\\b`));
    }
    await page.done();
  },

  async 'what is of cases without fault says so, and of no cases nothing is said'(path) {
    const page = await open(path);
    const { columns, latches, faults } = page.data.summary;
    const bare = faults.length > 0 ? / without fault/ : /cases?\b/;
    for (const [i, { by_end: [{ count, of }] }] of latches.entries()) {
      const told = await page.locator('#latches figure').nth(i).locator('.note').textContent();
      assert.match(told, of === 0 ? /^No case.* ran\.$/ : new RegExp(`\\b${count === 0 ? 'none of' : `${whole(count)} of`} ${whole(of)} case`));
      if (of > 0) assert.match(told, bare);
    }
    for (const [i, { spreads: [{ cases, count }] }] of columns.entries()) {
      const figure = page.locator(`[data-column="${i}"] .note`).last();
      if (count === 0) assert.match(await figure.textContent(), cases === 0 ? /^No case.* ran\.$/ : /^No case.* has this number\.$/);
    }
    if (faults.length > 0) {
      for (const id of ['latches', 'drivers'].filter((one) => one === 'latches' ? latches.length > 0 : columns.some(({ drivers }) => drivers.length > 0))) {
        assert.match(await page.locator(`#${id} > .note`).first().textContent(), bare, id);
      }
    }
    const together = page.data.facts.vary_together;
    if (together.length > 0) assert.match(await page.locator('#drivers > .note').last().textContent(), new RegExp(`^${together.join(', ')} vary together`));
    await page.done();
  },

  async 'it says what becomes of what was drawn'(path) {
    const page = await open(path);
    for (const [i, { is_result: isResult, description }] of page.data.summary.columns.entries()) {
      if (isResult) continue;
      assert.match(description, /^(value of|factor on|offset to) /);
      assert.equal(await page.locator(`[data-column="${i}"] .note`).first().textContent(), description);
    }
    await page.done();
  },

  async 'a grid, whose points are chosen, has no intervals, and any other sweep has'(path) {
    const page = await open(path);
    const isGrid = page.data.facts.method === 'grid';
    const [confidence, bands] = [page.getByText(/confidence|may be chance|bands/), page.locator('.band, .bound')];
    assert.equal(await confidence.count() === 0, isGrid);
    assert.equal(await bands.count() === 0, isGrid);
    await page.done();
  },

  async 'beside faults a lock-up that is never is a word and no place, and what nothing runs of is left out'(path) {
    const page = await open(path);
    const { columns, faults, counts } = page.data.summary;
    if (counts.ok === 0 || faults.length === 0) assert.equal(await page.locator('#faults').count(), 0);
    for (const [i, { is_result: isResult, spreads }] of columns.entries()) {
      const figure = page.locator(`#faults [data-boxes="${i}"]`);
      const rows = spreads.map(({ percentiles }) => percentiles.filter(({ percent }) => [5, 25, 50, 75, 95].includes(percent)).map(({ value }) => value));
      const isShown = isResult && faults.length > 0 && rows.some((values) => values.length > 0);
      assert.equal(await figure.count(), isShown ? 1 : 0);
      if (!isShown || rows.flat().every((value) => value === null)) continue;
      const count = (kind) => figure.locator(kind).count();
      const having = (test) => rows.filter((values) => values.length > 0 && test(values)).length;
      assert.equal(await count('text.never'), having((values) => values.includes(null)));
      assert.equal(await count('.whisker:not(.never)'), having(([least]) => least !== null));
      assert.equal(await count('.median'), having(([, , median]) => median !== null));
      // Lines end at their last number.
      const [low, high] = [Math.min, Math.max].map((of) => of(...rows.flat().filter((value) => value !== null)));
      const lines = await figure.locator('.whisker:not(.never)').evaluateAll((found) => found.map((one) => ['x1', 'x2'].map((end) => Number(one.getAttribute(end)))));
      const place = ([from, to], value) => from + ((to - from) * (value - low)) / (high - low);
      const ends = [Math.min, Math.max].map((of) => of(...lines.flat()));
      for (const [k, values] of rows.filter(([least]) => Number.isFinite(least)).entries()) {
        const last = values.findLast((value) => value !== null);
        if (high - low > 1e-9 * Math.abs(high)) assert.ok(Math.abs(lines[k][1] - place(ends, last)) < 0.5, `${lines[k]}`);
      }
    }
    await page.done();
  },

  async 'a rank correlation of zero has no sign'(path) {
    const page = await open(path);
    const told = await page.locator('#drivers td.number').allTextContents();
    assert.ok(told.every((text) => !/^\u22120\.00$/.test(text)), `${told}`);
    await page.done();
  },

  async 'curves of latches fill their pictures, however late they are'(path) {
    const page = await open(path);
    for (const [i, { times }] of page.data.summary.latches.entries()) {
      if (times.length < 2) continue;
      const steps = await page.locator('#latches figure').nth(i).locator('.curve').evaluate((curve) => {
        const places = [...curve.points].map(({ x, y }) => [x, y]);
        return places.filter(([, y], k) => k > 0 && y !== places[k - 1][1]).map(([x]) => x / curve.ownerSVGElement.viewBox.baseVal.width);
      });
      assert.ok(steps.at(-1) - steps[0] > 0.6, `${steps}`);
    }
    await page.done();
  },

  async 'each requirement has a row for each fault, and its bound stands in a histogram that reaches it'(path) {
    const page = await open(path);
    const { columns, requirements, faults } = page.data.summary;
    const groups = faults.length + 1;
    assert.equal(await page.locator('#requirements tbody tr').count(), groups * (requirements.length + (requirements.length > 1 ? 1 : 0)));
    for (const { result, at_least: least, at_most: most, met, first_broken: [first] } of requirements) {
      const row = page.locator('#requirements tbody tr').filter({ hasText: result }).first();
      assert.match(await row.textContent(), new RegExp(`${whole(met[0].count)} of ${whole(met[0].of)}`));
      assert.equal(await row.locator('.case').count(), first ? 1 : 0);
      const { histogram, unit } = columns.find(({ label }) => label === result);
      assert.ok(unit === null || (await row.textContent()).includes(`[${unit}]`), 'its bound has a unit');
      if (!histogram) continue;
      const { from, to } = histogram;
      const inside = [least, most].filter((bound) => bound !== undefined && bound > from && bound < to).length;
      assert.ok(await page.locator(`[data-column="${columns.findIndex(({ label }) => label === result)}"] line.limit`).count() >= inside);
    }
    await page.done();
  },

  async 'a case is chosen by keys, with the command that repeats it'(path) {
    const page = await open(path);
    const button = page.locator('#worst .case').last();
    const number = (await button.textContent()).replace(/\D/g, '');
    await page.fill('#command input', '1');
    await page.keyboard.press('Tab');
    assert.match(await page.textContent('#command code'), / --case 1$/);
    await button.focus();
    await page.keyboard.press('Enter');
    assert.match(await page.textContent('#command code'), new RegExp(`^nboom run .* --case ${number}$`));
    await page.done();
  },

  async 'it fits a phone, in light and dark, and prints'(path) {
    for (const colorScheme of ['light', 'dark']) {
      const page = await open(path, { width: 390, height: 844, colorScheme });
      const [content, screen] = await page.evaluate(() => [document.scrollingElement.scrollWidth, innerWidth]);
      assert.ok(content <= screen, `${content} pixels on a screen of ${screen}`);
      const background = () => page.$eval('body', (body) => getComputedStyle(body).backgroundColor.match(/\d+/g).slice(0, 3).reduce((a, b) => a + Number(b), 0));
      assert.equal(await background() < 380, colorScheme === 'dark');
      await page.keyboard.press('t');
      assert.equal(await background() < 380, colorScheme !== 'dark');
      await page.emulateMedia({ media: 'print' });
      assert.ok(await background() > 700, 'paper is white');
      assert.ok((await page.pdf({ format: 'A4' })).length > 20_000);
      await page.done();
    }
  },

  async 'texts of a study stay texts'(path) {
    const page = await open(path);
    assert.equal(await page.locator('img, b, script').count(), 2, 'data and program');
    const shown = await page.evaluate(() => [document.title, document.querySelector('h1').textContent, document.body.innerText]);
    const name = page.data.facts.name.replace(/[\u202a-\u202e\u2066-\u2069]/g, '\ufffd');
    assert.deepEqual(shown.slice(0, 2), [name, name]);
    assert.ok(!/[\u202a-\u202e\u2066-\u2069]/.test(shown[2]), 'nothing turns its direction');
    await page.done();
  },
};

let failed = 0;
for (const path of process.argv.slice(2).map((path) => resolve(path))) {
  for (const [name, check] of Object.entries(checks)) {
    try {
      await check(path);
      console.log(`ok  ${name}`);
    } catch (error) {
      failed += 1;
      console.log(`FAILED  ${name}, ${path}\n${error.stack}`);
    }
  }
}
await browser.close();
process.exit(failed === 0 ? 0 : 1);
