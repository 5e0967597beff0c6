// The motion of a report at several times, side by side in one picture:
//
//     node shoot.mjs report.html 0.5,1,2 OUT.webp
//
// or the top of the page:
//
//     node shoot.mjs report.html page OUT.webp
//
// or that of the page of a sweep, with two figures of each kind:
//
//     node shoot.mjs report.html sweep OUT.webp

import { existsSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { resolve } from 'node:path';

const require = createRequire(new URL('../../crates/nboom-report/page/package.json', import.meta.url));
const { chromium } = require('playwright-core');

const [report, times, out] = process.argv.slice(2);
const executablePath = process.env.CHROMIUM ?? ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync);
const browser = await chromium.launch({
  executablePath, args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});
const page = await browser.newPage({ viewport: { width: 1120, height: 1010 } });
await page.goto(`file://${resolve(report)}`);
await page.waitForSelector('html[data-ready]', { timeout: 60_000 });

/** The page of a sweep without what would make its picture too long to be read. */
async function shootSweep() {
  await page.addStyleTag({ content: `
    .figures > :nth-child(n+3), #results .wide, #account, #latches, #worst, #faults, #variables, #command { display: none !important }
    section { margin-top: 16px } #scatter svg { max-width: 760px }` });
  await page.waitForTimeout(300);
  return { time: '', png: await page.screenshot({ fullPage: true }) };
}

const slider = page.locator('#time-0');
const set = (share) => slider.evaluate((input, value) => {
  input.value = value;
  input.dispatchEvent(new Event('input'));
}, share);
const shots = [];
if (times === 'sweep') {
  shots.push(await shootSweep());
} else if (times === 'page') {
  await page.locator('[data-layer=trails]').check();
  await set(0.36);
  await page.evaluate(() => scrollTo(0, 0));
  await page.waitForTimeout(300);
  shots.push({ time: '', png: await page.screenshot() });
} else {
  await page.locator('[data-layer=trails]').check();
  for (const layer of ['axes', 'joints']) await page.locator(`[data-layer=${layer}]`).uncheck();
  // Runs begin at zero; the clock at the end of the slider tells their length.
  await set(1);
  const end = parseFloat((await page.textContent('.clock')).match(/[\d.]+/)[0]);
  for (const time of times.split(',').map(Number)) {
    await set(time / end);
    await page.waitForTimeout(300);
    shots.push({ time: `${time}`, png: await page.locator('.picture canvas').first().screenshot() });
  }
}
const images = shots.map(({ time, png }) => ({ time, data: png.toString('base64') }));
const webp = await page.evaluate(async (found) => {
  const pictures = await Promise.all(found.map(async ({ time, data }) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    return { time, image };
  }));
  // What no picture has anything in is cut off.
  const frame = { left: 1e9, top: 1e9, right: 0, bottom: 0 };
  for (const { image, time } of pictures) {
    const { width, height } = image;
    const flat = new OffscreenCanvas(width, height).getContext('2d');
    flat.drawImage(image, 0, 0);
    const { data } = flat.getImageData(0, 0, width, height);
    const off = (i) => Math.abs(data[i] - data[4 * (3 * width + 3)]) > 12;
    for (let y = 3; y < height - 3; y++) {
      for (let x = 3; x < width - 3; x++) {
        if (time && !off(4 * (y * width + x))) continue;
        frame.left = Math.min(frame.left, x - 24);
        frame.right = Math.max(frame.right, x + 24);
        frame.top = Math.min(frame.top, y - 24);
        frame.bottom = Math.max(frame.bottom, y + 24);
      }
    }
  }
  const [left, top] = [Math.max(frame.left, 0), Math.max(frame.top, 0)];
  const width = Math.min(frame.right, pictures[0].image.width) - left;
  const height = Math.min(frame.bottom, pictures[0].image.height) - top;
  const shape = width / height;
  const across = pictures.length === 1 || shape > 2.5 ? 1 : shape < 0.7 ? 4 : 2;
  const scale = pictures.length > 1 ? 960 / across / width : 0.8;
  const canvas = document.createElement('canvas');
  canvas.width = across * width * scale;
  canvas.height = Math.ceil(pictures.length / across) * height * scale;
  const flat = canvas.getContext('2d');
  flat.font = '15px system-ui, sans-serif';
  pictures.forEach(({ time, image }, i) => {
    const [x, y] = [(i % across) * width * scale, Math.floor(i / across) * height * scale];
    flat.drawImage(image, left, top, width, height, x, y, width * scale, height * scale);
    flat.fillStyle = '#24292f';
    if (time) flat.fillText(`${time} s`, x + 12, y + 24);
  });
  return canvas.toDataURL('image/webp', 0.85).split(',')[1];
}, images);
writeFileSync(out, Buffer.from(webp, 'base64'));
await browser.close();
