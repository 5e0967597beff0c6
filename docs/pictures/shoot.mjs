// The motion of a report at several times, side by side in one picture:
//
//     node shoot.mjs report.html 0.5,1,2 OUT.webp
//
// or, without times, the top of the page as it opens:
//
//     node shoot.mjs report.html page OUT.webp

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
const page = await browser.newPage({ viewport: { width: 1280, height: 900 } });
await page.goto(`file://${resolve(report)}`);
await page.waitForSelector('html[data-ready]', { timeout: 60_000 });

const shots = [];
if (times === 'page') {
  shots.push({ time: '', png: await page.screenshot() });
} else {
  for (const layer of ['axes', 'joints']) await page.locator(`[data-layer=${layer}]`).uncheck();
  await page.locator('[data-layer=trails]').check();
  const slider = page.locator('#time-0');
  const set = (share) => slider.evaluate((input, value) => {
    input.value = value;
    input.dispatchEvent(new Event('input'));
  }, share);
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
  const { width, height } = pictures[0].image;
  const across = pictures.length > 1 ? 2 : 1;
  const scale = pictures.length > 1 ? 480 / width : 0.8;
  const canvas = document.createElement('canvas');
  canvas.width = across * width * scale;
  canvas.height = Math.ceil(pictures.length / across) * height * scale;
  const flat = canvas.getContext('2d');
  flat.fillStyle = '#ffffff';
  flat.fillRect(0, 0, canvas.width, canvas.height);
  flat.font = '15px system-ui, sans-serif';
  pictures.forEach(({ time, image }, i) => {
    const [x, y] = [(i % across) * width * scale, Math.floor(i / across) * height * scale];
    flat.drawImage(image, x, y, width * scale, height * scale);
    flat.fillStyle = '#24292f';
    if (time) flat.fillText(`${time} s`, x + 12, y + 24);
  });
  return canvas.toDataURL('image/webp', 0.85).split(',')[1];
}, images);
writeFileSync(out, Buffer.from(webp, 'base64'));
await browser.close();
